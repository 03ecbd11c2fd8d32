"""The introduction that a first visitor sees."""

from playwright.sync_api import expect

from support.page import VISITOR, own_tab

IN_SIGHT = ".gallery:not(.away) .picture:visible"


def visible_trials(page):
    return page.locator(IN_SIGHT).evaluate_all("cells => cells.map((cell) => cell.dataset.name)")


ACTS = (["body", "sphere"], ["body", "sphere"], ["sphere", "surface"], ["surface", "circle", "bifurcation"])


def test_a_first_visitor_sees_two_dark_pictures_then_others_then_the_page_and_never_again(browser, server):
    with own_tab(browser, server, script=VISITOR) as explorer:
        page = explorer.page
        explorer.goto("/")
        introduction = page.get_by_role("region", name="Lesson", exact=True)
        assert explorer.dark
        assert page.locator(".param-scenes").is_hidden()
        sentences = []
        for number, pictures in enumerate(ACTS, start=1):
            sentences.append(introduction.locator(".title").text_content())
            page.locator(f"{IN_SIGHT}.picture-{pictures[-1]}").wait_for()
            assert sorted(visible_trials(page)) == sorted(pictures)
            for one in (introduction, *page.locator(IN_SIGHT).all()):
                # Edges lie between pixels.
                expect(one).to_be_in_viewport(ratio=0.997)
            if number == 1:
                # Beads of all bodies are there, not only of the default state.
                assert page.evaluate("hess.source('data-swarm').data.count") == 50
                page.mouse.wheel(0, 100)
            else:
                introduction.locator(".param-next-step").click()
        assert len(set(sentences)) == 4
        page.locator(".param-scenes").wait_for()
        assert introduction.count() == 0
        page.wait_for_function("document.documentElement.style.colorScheme === 'light'")
        # The address has the state now; a bare one has the whole page from now on.
        explorer.goto("/")
        assert introduction.count() == 0
