"""A lecture: the audience follows on phones, guesses, plays on its own, and comes back."""

import re

import pytest
from playwright.sync_api import expect

from hess_explorer.assets import modules_path
from hess_explorer.headless.browser import wait_ready
from hess_explorer.lessons import package_lessons
from hess_explorer.server.room_socket import SEVERAL
from support.accessible import assert_accessible
from support.asynchronous import finished
from support.barcode import read
from support.page import PHONE, POINTS, TOUCHED, own_tab
from support.room import Follower

LESSON, STEP = next(
    (one, i)
    for one in package_lessons().values()
    for i, step in enumerate(one.steps, 1)
    if step.prediction and step.prediction.kind == "point"
)
ASKED = LESSON.steps[STEP - 1].prediction
# Guesses of others, as shares of the axes.
OTHERS = [(0.2, 0.3), (0.7, 0.8)]


# The columns of the sources that a picture draws, by the modules of the page itself, which it exports.
COLUMNS = """async ([path, picture]) => {
  const lengthOf = (part) => typeof part === "string" ? 1 : part?.length ?? 1
  const { "pictures/gallery.js": { gallery } } = await import(path)
  const names = new Set(gallery.plot(picture).model.renderers.map((one) => one.data_source?.name).filter(Boolean))
  return Object.fromEntries([...names].filter((name) => gallery.source(name)).map((name) => (
    [name, Object.values(gallery.source(name).data).map((column) => Array.from(column, lengthOf))])))
}"""


def lengths(column):
    """Return the number of points in each part of a column."""
    return [len(part) if isinstance(part, list) else 1 for part in column]


def follows(page, query):
    """Wait until the page of a follower shows a state."""
    page.locator(f'html[data-query*="{query}"]').wait_for(state="attached", timeout=20_000)


@pytest.fixture
def lecture(tab, browser):
    """Return (lecturer, follower, code): the lecturer's page, a phone that follows, and the code of the room."""
    tab.fresh()
    tab.assert_quiet()
    page = tab.page
    with own_tab(browser, tab.base, PHONE, **TOUCHED) as phone:
        tab.begin_lesson(LESSON.name, STEP)
        tab.tool("invite")
        page.locator(".invite .code svg").wait_for()
        [address] = read(page.locator(".invite .code").screenshot())
        assert address.endswith(page.locator(".room-address").inner_text())
        # The tests' server listens on this machine only.
        assert "--address 0.0.0.0" in page.locator(".unreachable").inner_text()
        phone.page.goto(address)
        phone.page.wait_for_selector("html[data-ready=true]", state="attached")
        yield tab, phone, address.rpartition("/")[2]
    if page.locator(".param-invite").get_attribute("aria-pressed") == "true":
        page.keyboard.press("Escape")
        tab.tool("invite")
        page.get_by_role("button", name="End the lecture").click()
        page.locator(".param-invite[aria-pressed=false]").wait_for(state="attached")
        page.keyboard.press("Escape")
    tab.leave_lesson()
    tab.assert_quiet()


def test_a_guess_of_the_audience_from_the_invitation_to_how_far_it_was_off(lecture):
    tab, phone, code = lecture
    page, small, audience = tab.page, phone.page, tab.page.locator(".lesson .audience")
    page.get_by_text("1 follower", exact=True).wait_for()
    assert_accessible(page, page.locator(".invite"))
    page.keyboard.press("Escape")
    assert small.get_by_role("heading", name=LESSON.steps[STEP - 1].title).is_visible()
    # The picture fills the width of the phone, and nothing is cut.
    assert small.locator(".gallery:not(.away) .picture").bounding_box()["width"] >= 350
    assert small.evaluate("document.documentElement.scrollWidth") == 390
    expect(audience).to_have_text("0 guesses from the audience.")
    sheet = small.locator("canvas.guess")
    box = sheet.bounding_box()
    small.touchscreen.tap(box["x"] + 0.5 * box["width"], box["y"] + 0.4 * box["height"])
    expect(small.locator(".said")).to_have_text("Your guess is set.")
    expect(audience).to_have_text("1 guess from the audience.")
    x0, x1, y0, y1 = tab.axes(ASKED.picture)

    async def guess():
        for i, (x, y) in enumerate(OTHERS):
            other = await Follower.follow(tab.base, code, f"another-phone-{i}")
            await other.hear()
            await other.say({"guess": [[x0 + x * (x1 - x0), y0 + y * (y1 - y0)]], "step": STEP})
            await other.hear()
            await other.leave()

    finished(guess())
    expect(audience).to_have_text("3 guesses from the audience.")
    assert_accessible(small)
    tab.change(page.keyboard.press, "PageDown")
    page.locator("canvas.audience").wait_for(state="attached")
    # How far one is off is measured in "static/guess.test.mjs".
    median = r"3 guesses from the audience\. Median distance: \S+ in .* and \S+ in .*\."
    expect(audience).to_have_text(re.compile(median))
    expect(small.locator(".said")).to_have_text(re.compile(r"You were .* away\."))
    # The phone draws what the projector draws, and nothing of the state before; no player moves a point there.
    drawn = small.evaluate(COLUMNS, [f"{tab.base}/{modules_path()}/page/follow.js", ASKED.picture])
    assert drawn
    for name, columns in drawn.items():
        if name not in POINTS:
            assert columns == [lengths(column) for column in tab.data(name).values()], name
    # The end of the step takes the guesses away, also that of the lesson, after which no state comes.
    tab.turn_to_step(STEP + 1)
    page.locator("canvas.audience").wait_for(state="detached")
    small.get_by_role("heading", name=LESSON.steps[STEP].title).wait_for()
    expect(small.locator(".said")).to_be_hidden()
    assert sheet.count() == 0
    tab.leave_lesson()
    expect(small.locator(".lesson")).to_be_hidden()


@pytest.mark.thorough
def test_a_follower_plays_alone_and_comes_back_and_the_room_outlives_a_reload(lecture):
    tab, phone, _ = lecture
    page, small = tab.page, phone.page
    sockets = []

    def connect(socket):
        socket.connect_to_server()
        sockets.append(socket)

    def link(name):
        return small.get_by_role("link", name=name)

    page.keyboard.press("Escape")
    tab.leave_lesson()
    tab.show("loxodrome")
    follows(small, "scene=loxodrome")
    assert small.locator(".lesson").is_hidden()
    link("Let go").tap()
    wait_ready(small)
    assert phone.scene == "loxodrome"
    phone.show("kharlamova")
    # The lecturer does not notice, goes on, and reloads the page.
    tab.show("free-suslov")
    page.reload()
    wait_ready(page)
    page.locator(".param-invite[aria-pressed=true]").wait_for(state="attached")
    assert tab.scene == "free-suslov"
    small.route_web_socket(re.compile("/rooms/"), connect)
    link("Back to the lecture").tap()
    follows(small, "scene=free-suslov")
    # A phone that loses its connection finds the last state when it is back.
    sockets.pop().close(code=1001)
    small.get_by_text("Connection lost.").wait_for()
    tab.show("loxodrome")
    follows(small, "scene=loxodrome")
    assert len(sockets) == 1
    tab.tool("invite")
    page.get_by_role("button", name="End the lecture").click()
    for one in (small, page):
        one.get_by_text("The lecture has ended.").wait_for()
    page.keyboard.press("Escape")
    link("Open Hess Explorer").tap()
    wait_ready(small)
    assert link("Back to the lecture").count() == 0


def test_where_there_is_no_room_the_pages_say_why(browser, server):
    page = browser.new_page()
    page.route_web_socket(re.compile("/rooms/"), lambda socket: socket.close(code=SEVERAL[0], reason=SEVERAL[1]))
    page.goto(f"{server}/")
    wait_ready(page)
    page.locator(".param-invite").dispatch_event("click")
    expect(page.locator(".room-count")).to_have_text(SEVERAL[1])
    for absent in (page.get_by_text("Scan the code"), page.get_by_role("button", name="End the lecture")):
        expect(absent).to_be_hidden()
    page.close()
    page = browser.new_page()
    page.goto(f"{server}/r/AAAAAA")
    page.get_by_text("There is no such room: its lecture has ended, or the code is wrong.").wait_for()
    assert page.get_by_role("link", name="Open Hess Explorer").get_attribute("href") == "./"
    page.close()
