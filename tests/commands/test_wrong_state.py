"""Commands reject an invalid state; in lenient mode they correct it and report the changes."""

import json

import pytest

import hess_explorer as hess
from hess_explorer.__main__ import main
from hess_explorer.export.picture_data import address
from hess_explorer.headless import screenshot
from hess_explorer.page.opening import opening
from hess_explorer.protocol.specs import PAGE_KEYS, Link, encode
from hess_explorer.scenes import scenes
from support.command_line import typed

# What is wrong with a link → how the sentence about it begins.
WRONG = {
    "scene=nope": "'scene=nope' cannot be used: Scene must be one of suslov-hess, ",
    "h=abc": "'h=abc' cannot be used: h must be a finite number between -1 and 1e6; correct it",
    "hh=1.2": "The scene suslov-hess has no parameter 'hh', only I22, I23, ",
    "h=1&h=2": "The link contains 'h' more than once",
    "v=0&h=1.2": "The link was made by another version of this page",
    "accuracy=best": "'accuracy=best' cannot be used: Accuracy must be one of draft, standard, precise, reference,",
    "t=-1": "'t=-1' cannot be used: t must lie between 0 and 1e6",
    "h=0.2&f=5": "At h = 0.2 the largest possible |f| is ",
    "scene=own-body&U=abs(g1)": "'U=abs(g1)' cannot be used: Potential U(γ): This is not a polynomial: ",
    "scene=suslov&starts=1": "'starts=1' cannot be used: The points of the chosen orbits must be points x,y;x,y",
}
COMMANDS = {
    "export": ("export", "--format", "json", "--out"),
    "figure": ("export", "--format", "svg", "--out"),
    "html": ("export", "--format", "html", "--out"),
    "code": ("export", "--format", "py", "--out"),
    "notebook": ("export", "--format", "ipynb", "--out"),
    "shot": ("shot",),
}
# All that can be wrong, for one of the exports, and for the command that has the keys of the page too.
CASES = [
    *((name, "h=abc") for name in COMMANDS),
    *(("export", state) for state in WRONG),
    *(("shot", state) for state in ("theme=blue", "large=nothing", "lesson=none", "embed=2")),
]


@pytest.mark.parametrize(("command", "state"), dict.fromkeys(CASES))
def test_a_command_refuses_what_it_does_not_understand_and_writes_nothing(
    command, state, tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr(screenshot, "screenshot", lambda *given, **more: pytest.fail("the page was drawn"))
    first, *more = COMMANDS[command]
    assert main([first, "--state", state, *more, str(tmp_path / "out")]) == 2
    said = capsys.readouterr()
    assert said.err.startswith(f"hess-explorer: {WRONG.get(state, repr(state))}")
    assert said.err.endswith("; correct it, or use --lenient (in Python lenient=True) to have it corrected.\n")
    assert said.err.count("\n") == 1
    assert said.out == ""
    assert not list(tmp_path.iterdir())


def test_leniently_it_is_put_right_and_noted(capsys):
    words = "export --state scene=nope&h=abc&hh=1.2&f=1e9&accuracy=draft --lenient --picture circle --format json"
    assert main(typed(words)) == 0
    facts = json.loads(capsys.readouterr().out)
    assert (facts["scene"], facts["parameters"]["h"]) == ("suslov-hess", scenes()["suslov-hess"].defaults()["h"])
    assert [note.partition(" ")[0] for note in facts["notes"][:4]] == ["Scene", "The", "h", "f"]


@pytest.mark.parametrize(
    "state",
    [
        "?h=1.2&f=0.3",
        "http://localhost:5006/?h=1.2&f=0.3",
        "https://example.org/explorer/?v=1&h=1.2&f=0.3&theme=dark&large=circle&present=1",
    ],
)
def test_a_whole_link_of_the_page_is_understood(state, capsys):
    assert main(["export", "--format", "py", "--state", state]) == 0
    assert "h=1.2, f=0.3" in capsys.readouterr().out.replace("\n", " ").replace("    ", "")


@pytest.mark.parametrize("name", scenes())
def test_every_link_that_the_page_writes_is_accepted(name):
    scene = scenes()[name]
    for values in (scene.defaults(), *map(scene.example, scene.presets)):
        admitted = scene.admit({**scene.defaults(), **values})[0]
        link = encode(name, admitted)
        assert address(link).values == admitted
        assert hess.from_link(link).link == f"?{link}"
        assert opening(link, lenient=False).notes == []


def test_what_a_page_keeps_in_its_link_is_known(monkeypatch):
    asked, read = set(), Link.value

    def value(link, spec):
        asked.add(spec.name)
        return read(link, spec)

    monkeypatch.setattr(Link, "value", value)
    opening("scene=suslov-hess")
    assert asked - {spec.name for spec in scenes()["suslov-hess"].specs} == set(PAGE_KEYS) - {"v"}
