"""The page in a browser: user actions (`Explorer`), and what the page shows."""

import json
import re
from contextlib import closing, contextmanager
from urllib.parse import parse_qsl, urlsplit

from hess_explorer.headless.browser import wait_ready
from hess_explorer.scenes import scenes
from support.modules import look_inside
from support.view import numbers_in

HESS, STUDY = "suslov-hess", "suslov-hess-accuracy"
FIRST = next(iter(scenes()))
"""The scene of a page whose address names none."""
DEFAULTS = scenes()[HESS].defaults()
POINTS = ("omega-point", "bifurcation-point", "circle-point")
PICTURES = ("omega", "sphere", "bifurcation", "circle")
WIDE = (1600, 950)
"""The size of the window that most tests share."""
PHONE, TOUCHED = (390, 844), {"has_touch": True, "is_mobile": True}
SLIDERS = {"I22": 0.01, "I23": 0.01, "b3": 0.01, "h": 0.01, "f": 0.01, "phi0": 0.01, "span": 1.0}
"""The numbers, with the step of each slider at the default state."""

VISITOR = "Object.defineProperty(navigator, 'webdriver', { get: () => false })"
"""The introduction is not for programs that drive a browser."""


def scene_of(query):
    """Return the query with the Suslov–Hess scene as its default; the tests do not depend on the page's first scene."""
    return query if "scene=" in query else f"scene=suslov-hess&{query}".rstrip("&")


def sized(width, height):
    return {"width": width, "height": height}


class Explorer:
    """An open page: user actions, and what it shows."""

    def __init__(self, page, base):
        self.page = page
        self.base = base
        self.errors, self.outside, self.sent, self.received = [], [], [], []
        look_inside(page)
        # Long enough for a machine that does much else; nothing is measured here.
        page.set_default_timeout(60_000)
        host = urlsplit(base).netloc

        def on_url(url):
            if urlsplit(url).netloc not in ("", host):
                self.outside.append(url)

        # That the server is alive is asked after some seconds of silence, whatever else is done.
        def on_sent(frame):
            self.sent += [frame] if frame != '{"alive": true}' else []

        def on_received(frame):
            self.received += [frame] if frame != "" else []

        def on_socket(socket):
            on_url(socket.url)
            socket.on("framesent", on_sent)
            socket.on("framereceived", on_received)

        page.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("request", lambda request: on_url(request.url))
        page.on("websocket", on_socket)

    def open(self, query=""):
        """The page of a query; one that names no scene is one of the Suslov–Hess scene."""
        return self.goto(f"/?{scene_of(query)}")

    def goto(self, address):
        """Open exactly this address."""
        self.page.goto(self.base + address)
        wait_ready(self.page)
        return self.unfold_controls()

    def unfold_controls(self):
        """Expand all groups of controls; they stay open in every scene."""
        self.page.locator("details.group").evaluate_all("groups => groups.forEach((group) => { group.open = true })")
        return self

    def fresh(self, scene=HESS):
        """Bring the page to the first state of a scene, at t = 0, at rest, the sphere turned back.

        The result is that of `open`, in a tenth of the time.
        """
        page = self.page
        # Whatever a test that failed still held.
        page.mouse.up()
        self.sent.clear()
        self.received.clear()
        if page.viewport_size != sized(*WIDE):
            page.set_viewport_size(sized(*WIDE))
        if not page.url.startswith(self.base) or not self.ready:
            return self.open(f"scene={scene}")
        self.leave_lesson()
        self.turn_theme(is_dark=False)
        self.show(scene)
        page.evaluate(AT_REST)
        # No picture is enlarged.
        page.keyboard.press("Escape")
        self.change(self.tell, "reset")
        self.set_time(0.0)
        page.mouse.move(5, 5)
        return self

    def fold_controls(self):
        """Restore the initial state of the groups of controls."""
        self.page.locator("details.group").evaluate_all("groups => groups.forEach((group) => { group.open = false })")

    def resize(self, width, height):
        """Resize the window and wait until everything is repainted."""
        self.page.set_viewport_size(sized(width, height))
        wait_frames(self, 4)

    @property
    def dark(self):
        return self.page.evaluate("document.documentElement.style.colorScheme") == "dark"

    def turn_theme(self, *, is_dark):
        """Switch between dark and light, and wait for the plots' colours, which follow some frames later."""
        if self.dark == is_dark:
            return
        before = self.page.evaluate(COLOURS)
        self.tell("theme")
        self.page.wait_for_function(f"before => ({COLOURS}).every((colour, i) => colour !== before[i])", arg=before)
        wait_frames(self, 3)

    def assert_quiet(self):
        """Assert that there were no errors and no requests to other hosts; each is reported once."""
        errors, outside = self.errors.copy(), self.outside.copy()
        self.errors.clear()
        self.outside.clear()
        assert not errors, errors
        assert not outside, outside

    # State of the page.

    @property
    def state(self):
        return int(self.page.evaluate("document.documentElement.dataset.state"))

    @property
    def ready(self):
        return self.page.evaluate("document.documentElement.dataset.ready") == "true"

    def data(self, name):
        """The columns of a source of the scene on show; nested lists for polygons and lines of several parts.

        What is not finite comes as None.
        """
        # As one text: Playwright packs numbers one by one, which takes ten times as long.
        return json.loads(
            self.page.evaluate(
                """name => {
              const plain = (x) => ArrayBuffer.isView(x) || Array.isArray(x) ? Array.from(x, plain)
                : x?.numbers ? plain(x.numbers) : x
              const columns = Object.entries(hess.source(name).data)
              return JSON.stringify(Object.fromEntries(columns.map(([key, column]) => [key, plain(column)])))
            }""",
                name,
            )
        )

    def torus(self):
        """(h, f) of their boxes."""
        return self.shown("h")[0], self.shown("f")[0]

    def here(self):
        """(h, f) where the ring stands in the bifurcation diagram."""
        ring = self.data("bifurcation-here")
        return ring["h"][0], ring["f"][0]

    def axes(self, name):
        """(x from, x to, y from, y to) of a planar picture."""
        return self.page.evaluate(
            """name => {
              const { x_range: x, y_range: y } = hess.plots.find(({ model }) => model.name === name).model
              return [x.start, x.end, y.start, y.end]
            }""",
            name,
        )

    def picture(self, name):
        """A picture of the scene on show, with its caption: those of scenes seen before stay where they are, unseen."""
        return self.page.locator(f".gallery:not(.away) .picture-{name}")

    def caption(self, picture):
        return self.picture(picture).locator(".caption").text_content().strip()

    def text(self, look):
        """Return the text of the status line's details, the notes or the derived quantities."""
        return self.page.locator({"status": ".text.details"}.get(look, f".text.{look}")).text_content()

    @property
    def scene(self):
        """The name of the scene on show."""
        return self.page.evaluate("document.documentElement.dataset.scene")

    def chosen(self, menu):
        """The option that a menu shows, in its words."""
        return self.menu(menu).evaluate("menu => menu.selectedOptions[0]?.textContent ?? null")

    def shown(self, name):
        """(box, slider) of a number."""
        return float(self.box(name).input_value()), float(self.slider(name).input_value())

    @property
    def time(self):
        return float(self.page.locator("input.param-t").input_value())

    @property
    def playing(self):
        return self.page.locator(".player[role=group]").get_attribute("data-playing") == "true"

    @property
    def turn(self):
        """(azimuth, elevation) of the sphere as it is painted."""
        return tuple(map(float, self.sphere.get_attribute("data-turn").split()))

    def link(self):
        """Return the link that "Copy link" writes for the current state, without the pause of the address bar."""
        self.page.locator(".param-link").dispatch_event("click")
        return self.page.url

    def wait_url(self, **values):
        """Wait until the address bar has these values, and return all its values."""
        self.page.wait_for_function(
            "wanted => wanted.every(([key, value]) => new URLSearchParams(location.search).get(key) === value)",
            arg=[[key, str(value)] for key, value in values.items()],
        )
        return dict(parse_qsl(urlsplit(self.page.url).query))

    # User actions.

    def slider(self, name):
        return self.page.locator(f".param-{name} input[type=range]")

    def box(self, name):
        return self.page.locator(f".param-{name} input[type=text]")

    def menu(self, name):
        return self.page.locator(f".param-{name} select")

    @property
    def sphere(self):
        """The Poisson sphere of the scene on show, in the lead."""
        sphere = self.page.locator(".gallery:not(.away) canvas.sphere")
        if sphere.count():
            self.lead("sphere")
        return sphere

    def lead(self, picture):
        """Put a picture in the lead, where the mouse and the keys reach it."""
        self.unfold(picture)
        if "aside" in self.picture(picture).get_attribute("class").split():
            self.tell("look", picture)
            wait_frames(self, 3)

    def open_text(self):
        """Open the drawer of the text, which `fresh` closes."""
        if not self.page.locator(".reader").is_visible():
            self.page.locator(".param-text").click()

    def tool(self, name):
        """Press a tool of the bar or of its menus."""
        self.page.locator(f".param-{name}").dispatch_event("click")

    def unfold(self, picture):
        """Show a picture that starts collapsed."""
        if "folded" in self.picture(picture).get_attribute("class").split():
            self.change(self.fold, picture)

    def fold(self, picture):
        """Press the button that shows a picture, or folds it again."""
        self.page.locator(f".unfold-{picture}").click()

    def change(self, action, *arguments):
        """Do something that requests a new state, and wait until it is painted."""
        before = self.state
        action(*arguments)
        wait_ready(self.page, after=before)

    def click(self, x, y):
        """Click in a picture, and wait until no second click can follow."""
        self.page.mouse.click(x, y)
        self.page.wait_for_timeout(300)

    def tell(self, name, detail=None):
        """Send a message on the page's bus, as the controls do, also while they are out of sight."""
        self.page.evaluate("([name, detail]) => hess.tell(name, detail)", [name, detail])

    def show(self, scene):
        """Change to a scene, also to one that the menu does not offer at the scene on show."""
        if self.scene != scene:
            self.change(self.tell, "scene", scene)

    def enter(self, scene):
        """Choose a scene from the menu."""
        self.open_menu()
        self.change(self.page.locator(f".param-scene-{scene}").click)

    def open_menu(self):
        """Open the menu of scenes."""
        self.page.locator(".param-scenes").click()

    def turn_to(self, picture):
        """Choose a picture on a phone, which shows one large."""
        if self.picture(picture).is_visible():
            self.lead(picture)
        else:
            self.change(self.page.locator(f".unfold-{picture}").click)

    def begin_lesson(self, name, step=1):
        """Choose a lesson from the menu, which may be folded, and go on to a step."""
        self.change(self.page.locator(f".param-lesson-{name}").dispatch_event, "click")
        self.turn_to_step(step)

    def turn_to_step(self, number):
        """Go on in the lesson to this step, past guesses and questions."""
        count = self.page.locator(".lesson .count")
        while not count.inner_text().startswith(f"{number} /"):
            self.page.keyboard.press("PageDown")
            wait_ready(self.page)

    def leave_lesson(self):
        """Leave the lesson, if there is one."""
        button = self.page.locator(".param-leave-lesson")
        if button.is_visible():
            button.click()
        # In a narrow window a lesson chooses the text, and leaves it chosen.
        self.page.locator(".param-tab-controls").evaluate("tab => tab.click()")

    def type(self, name, text):
        """Type into the box of a number, and press Enter."""
        box = self.box(name)
        box.evaluate(UNFOLD)
        box.fill(text)
        box.press("Enter")

    def slide(self, **values):
        """Move sliders all at once, as one input event each."""
        return self.page.evaluate(SLIDE, list(values.items()))

    def move(self, **values):
        """Move sliders, and wait until the new state is painted."""
        self.change(lambda: self.slide(**values))

    def choose(self, menu, option):
        """Choose an option of a menu, expanding its group if needed."""
        self.menu(menu).evaluate(UNFOLD)
        self.menu(menu).select_option(label=option)

    def set_time(self, t):
        """Move the time slider."""
        self.page.locator("input.param-t").evaluate(
            "(slider, t) => { slider.value = t; slider.dispatchEvent(new Event('input'));"
            " slider.dispatchEvent(new Event('change')) }",
            t,
        )


UNFOLD = "item => item.closest('details')?.setAttribute('open', '')"
FIND = """(name, kind) => {
  const find = (root, selector) => {
    const found = root.querySelector(selector)
    if (found) return found
    for (const item of root.querySelectorAll("*")) {
      const inside = item.shadowRoot && find(item.shadowRoot, selector)
      if (inside) return inside
    }
    return null
  }
  return find(document, `.param-${name} input[type=${kind}]`)
}"""
# All within one task of the browser; the answer is whether the page still says it is ready.
SLIDE = f"""pairs => {{
  for (const [name, value] of pairs) {{
    const slider = ({FIND})(name, "range")
    slider.value = value
    slider.dispatchEvent(new Event("input", {{ bubbles: true }}))
  }}
  return document.documentElement.dataset.ready
}}"""
ALL = """const all = (root) => [...root.querySelectorAll("*")].flatMap((item) =>
  [item, ...(item.shadowRoot ? all(item.shadowRoot) : [])])"""
"""Every element of the page, those in shadow roots too."""
# Home, pressed on what is turned: a picture turns only while it is seen.
HOMEWARDS = f"""() => {{
  {ALL}
  const turning = ".gallery:not(.away) canvas:is(.sphere, .solid, .torus)"
  for (const item of all(document).filter((one) => one.matches(turning)))
    if (item.checkVisibility())
      item.dispatchEvent(new KeyboardEvent("keydown", {{ key: "Home", bubbles: true, composed: true }}))
}}"""
# Pause, speed 1, spheres turned back, extra pictures folded, groups of controls open, nothing in focus.
AT_REST = f"""() => {{
  ({HOMEWARDS})()
  {ALL}
  for (const item of all(document)) {{
    if (item.matches(".player[role=group][data-playing=true]")) item.querySelector(".param-play").click()
    if (item.matches(".param-speed") && item.value !== "1") {{
      item.value = "1"
      item.dispatchEvent(new Event("change", {{ bubbles: true }}))
    }}
    if (item.matches(".chip[aria-pressed=true]") && item.checkVisibility()) item.click()
    if (item.matches("details.group")) item.open = true
    if (item.matches(".param-text[aria-expanded=true]") && item.checkVisibility()) item.click()
  }}
  document.activeElement?.blur()
}}"""
# The colour of the axes of each plot in sight.
COLOURS = "hess.plots.flatMap(({ model }) => model.below).map((axis) => axis.major_label_text_color)"


@contextmanager
def own_tab(browser, server, size=WIDE, script="", **options):
    """A tab of its own, in which nothing is loaded yet; at the end assert no errors and no requests to other hosts."""
    # A scene begins at rest.
    with closing(browser.new_context(viewport=sized(*size), **{"reduced_motion": "reduce", **options})) as context:
        context.add_init_script(script)
        explorer = Explorer(context.new_page(), server)
        yield explorer
        explorer.assert_quiet()


def one_tab(browser, server):
    """Yield one tab for many tests: loading a page takes longest."""
    with own_tab(browser, server, permissions=["clipboard-read", "clipboard-write"]) as explorer:
        yield explorer


def brought_on_phone(phone_tab, scene=HESS):
    """The page on a phone in the first state of a scene, with its first picture and control."""
    page = phone_tab.page
    phone_tab.leave_lesson()
    phone_tab.turn_theme(is_dark=False)
    if page.viewport_size != sized(*PHONE):
        phone_tab.resize(*PHONE)
    phone_tab.show(scene)
    phone_tab.turn_to(scenes()[scene].pictures[0])
    page.locator(".chooser button").evaluate_all("([first]) => first?.click()")
    page.evaluate(HOMEWARDS)
    phone_tab.change(phone_tab.tell, "reset")
    return phone_tab


class Websocket:
    """Proxy between a page and its server that can hold back the server's messages."""

    def __init__(self, page):
        self._socket, self._held, self._holding = None, [], False
        page.route_web_socket(re.compile(r"/states(\?|$)"), self._connect)

    def _connect(self, socket):
        self._socket = socket
        socket.connect_to_server().on_message(self._hear)

    def _hear(self, message):
        if self._holding:
            self._held.append(message)
        else:
            self._socket.send(message)

    def hold(self):
        self._holding = True

    def cut(self):
        """Close the connection as when the server ends."""
        self._socket.close()

    def release(self):
        self._holding = False
        while self._held:
            self._socket.send(self._held.pop(0))


def flat(data):
    """All numbers of a source's columns, however nested, in order."""
    if isinstance(data, dict):
        return [x for key in sorted(data) for x in flat(data[key])]
    return [x for part in data for x in flat(part)] if isinstance(data, list) else [data]


# The time and the points that belong to it, and where the sphere shows its point: from one task of the browser.
MOMENT = """names => {
  const of = (name) => hess.source(name).data
  const find = (root, selector) => {
    for (const item of [root, ...root.querySelectorAll("*")]) {
      const found = item.shadowRoot && (item.shadowRoot.querySelector(selector) ?? find(item.shadowRoot, selector))
      if (found) return found
    }
    return null
  }
  const points = names.map((name) => [of(name).x[0], of(name).y[0]])
  return { t: Number(find(document, "input.param-t").value), points }
}"""


def wait_frames(explorer, count=6):
    """Wait until the browser has painted this many frames."""
    explorer.page.evaluate(
        "async (count) => { while (count-- > 0) await new Promise((done) => requestAnimationFrame(done)) }", count
    )


def wait_time(explorer, condition):
    """Wait until t on the time slider fulfils a condition."""
    explorer.page.wait_for_function(f"() => {{ const {{ t }} = ({MOMENT})({list(POINTS)!r}); return {condition} }}")


def said(explorer, picture, pattern):
    """Return the numbers in a caption at the places of # in the pattern."""
    explorer.unfold(picture)
    return numbers_in(explorer.caption(picture), pattern)


def values_of(explorer, scene):
    """The state in the address bar."""
    query = dict(parse_qsl(urlsplit(explorer.page.url).query, keep_blank_values=True))
    return {spec.name: type(spec.default)(query[spec.name]) for spec in scene.specs}
