"""Pages in files, opened from the disk without any network."""

from contextlib import contextmanager

from support.page import WIDE

READY = "html[data-ready=true]"


@contextmanager
def opened(browser, address, size=WIDE, ready=READY, **options):
    """The page of a file; no error, and no request but for the file itself.  `ready` is there once it can be used."""
    width, height = size
    context = browser.new_context(
        viewport={"width": width, "height": height}, offline=True, reduced_motion="reduce", **options
    )
    errors, asked = [], []
    context.on("console", lambda message: errors.append(message.text) if message.type in ("error", "warning") else None)
    context.on("weberror", lambda error: errors.append(str(error.error)))
    context.on("request", lambda request: asked.append(request.url))
    try:
        page = context.new_page()
        page.set_default_timeout(30_000)
        page.goto(address)
        page.wait_for_selector(ready, state="attached")
        yield page
        assert errors == []
        assert {url.partition("#")[0] for url in asked if not url.startswith(("data:", "blob:"))} == {
            address.partition("#")[0]
        }
    finally:
        context.close()


def state(page):
    """The number of states painted so far."""
    return int(page.locator("html").get_attribute("data-state"))


def change(page, action, *arguments):
    """Do something that shows another state, and wait until it is painted."""
    before = state(page)
    action(*arguments)
    settled(page, before)


def move(page, slider):
    """Move a slider to both ends, first to the one where it is not."""
    is_last = slider.evaluate("({ value, max, step }) => max - value < step / 2")
    for key in ("Home", "End") if is_last else ("End", "Home"):
        change(page, slider.press, key)


def settled(page, before):
    """Wait until a state after that number is painted."""
    # The file's policy forbids `wait_for_function`.
    for _ in range(6000):
        if state(page) > before and page.locator(READY).count():
            return
        page.wait_for_timeout(10)
    raise AssertionError("no other state was painted")


def captions(page):
    """Title, verdict and numbers of the pictures by name."""
    read = "all => all.map((cell) => [cell.dataset.name, cell.querySelector('.caption').innerText])"
    return dict(page.locator(".gallery:not(.away) .picture").evaluate_all(read))
