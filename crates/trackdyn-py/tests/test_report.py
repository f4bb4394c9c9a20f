"""The page of a diagnosis: whole in itself, and alive in a browser."""

from __future__ import annotations

import json
from html.parser import HTMLParser

import numpy as np
import pytest
from browser import Browser, missing

import trackdyn as td

LARGEST = 1_000_000
ENTER, RIGHT = "Enter", "ArrowRight"


@pytest.fixture(scope="module")
def pages(diagnosis, robot, tmp_path_factory):
    """A drive and a table of steady points, on a page each."""
    folder = tmp_path_factory.mktemp("pages")
    speeds = np.stack(np.meshgrid(np.linspace(-0.8, 0.8, 9), np.linspace(-0.8, 0.8, 9)), -1)
    left, right = speeds.reshape(-1, 2).T
    x_l, x_r, y = -0.37538, 0.45735, 0.04923
    yaw_rate = (right - left) / (x_r - x_l)
    motion = [(left + right) / 2 - yaw_rate * (x_l + x_r) / 2, -yaw_rate * y, yaw_rate]
    noise = np.random.default_rng(1).normal(0.0, 0.003, (3, len(left)))
    table = np.stack([left, right, *(np.array(motion) + noise)], -1)
    points = folder / "points.csv"
    head = "v_left,v_right,v_forward,v_lateral,yaw_rate"
    np.savetxt(points, table, "%.5f", ",", header=head, comments="")
    steady = td.diagnose(td.read_recording(points), robot, draws=1000)
    files = {}
    for name, of in {"drive": diagnosis, "points": steady}.items():
        files[name] = folder / f"{name}.html"
        files[name].write_text(of.report(), encoding="utf-8")
    return files


class Page(HTMLParser):
    """What a page holds, outside of its scripts."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str]]] = []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, {key: value or "" for key, value in attrs}))

    def all(self, tag: str) -> list[dict[str, str]]:
        return [attributes for name, attributes in self.tags if name == tag]


@pytest.mark.parametrize("name", ["drive", "points"])
def test_a_page_is_whole_in_itself(pages, name):
    text = pages[name].read_text(encoding="utf-8")
    assert len(text.encode()) < LARGEST
    page = Page(text)
    for attributes in (attributes for _, attributes in page.tags):
        assert not {"src", "srcset", "data", "action", "poster"} & set(attributes), attributes
        assert attributes.get("href", "#").startswith("#"), attributes
    assert not page.all("link") and not page.all("iframe")
    policies = [of["content"] for of in page.all("meta") if "http-equiv" in of]
    assert any(policy.startswith("default-src 'none'") for policy in policies)
    assert [of["lang"] for of in page.all("html")] == ["en"] and len(page.all("title")) == 1


@pytest.mark.parametrize("name", ["drive", "points"])
def test_a_page_is_labelled(pages, name):
    page = Page(pages[name].read_text(encoding="utf-8"))
    assert len(page.all("h1")) == 1
    ids = [attributes["id"] for _, attributes in page.tags if "id" in attributes]
    assert len(ids) == len(set(ids))
    for _, attributes in page.tags:
        for key in ("aria-labelledby", "aria-describedby"):
            assert set(attributes.get(key, "").split()) <= set(ids), attributes
    for figure in page.all("figure"):
        assert figure.get("aria-labelledby"), figure
    # a picture inside another clips, and is no picture of its own
    pictures = [of for of in page.all("svg") if "role" in of]
    assert pictures and all(of.get("aria-label") or of.get("aria-labelledby") for of in pictures)
    levels = [int(tag[1]) for tag, _ in page.tags if tag in ("h1", "h2", "h3", "h4")]
    assert levels[0] == 1 and all(after - before <= 1 for before, after in zip(levels, levels[1:]))


@pytest.fixture(params=[(1280, "light"), (390, "dark")], ids=["wide", "narrow"])
def browser(request, tmp_path):
    lacking = missing()
    if lacking:
        pytest.skip(f"the page was not opened: {lacking}")
    opened = Browser(tmp_path / "profile", *request.param)
    yield opened
    opened.close()


def quiet(browser, page):
    assert browser.complaints() == []
    assert browser.requests() == [page.as_uri()]
    across = "const of = document.documentElement; return of.scrollWidth - of.clientWidth"
    assert browser.run(across) <= 0


def test_a_drive_is_looked_at_closely(pages, browser):
    browser.open(pages["drive"])
    text = "return document.getElementById('{}').textContent"
    assert browser.run("return !document.getElementById('close').hidden")
    before = browser.run(text.format("moment"))
    browser.run("document.getElementById('cursor').focus()")
    browser.press(RIGHT)
    assert browser.run(text.format("moment")) != before
    browser.run("document.querySelector('#plane .cell[tabindex=\"0\"]').focus()")
    browser.press(RIGHT)
    browser.press(ENTER)
    assert browser.run(text.format("heard")).startswith("Tracks ")
    assert browser.run(text.format("which")).startswith("stretch 1 of ")
    # what is said of the cell is what the page holds of it
    shown = browser.run("return document.activeElement.dataset.cell")
    values = json.loads(browser.run(text.format("values")))["plane"]
    yaw = next(of for of in values["panels"] if of["title"] == "yaw, before")
    value = f"{yaw['v'][int(shown)] * yaw['step']:.2f}".replace("-", "−")
    assert f"yaw {value} before" in browser.run(text.format("heard"))
    assert not browser.run("return document.getElementById('all').disabled")
    browser.press("0")
    assert browser.run("return document.getElementById('all').disabled")
    quiet(browser, pages["drive"])


def test_points_are_looked_at_closely(pages, browser):
    browser.open(pages["points"])
    browser.run("document.querySelector('#plane .cell[tabindex=\"0\"]').focus()")
    browser.press(RIGHT)
    assert browser.run("return document.getElementById('said').textContent").startswith("Tracks ")
    assert browser.run("return document.getElementById('times')") is None
    quiet(browser, pages["points"])


def test_without_scripts_and_on_paper_all_figures_are_there(pages):
    text = pages["drive"].read_text(encoding="utf-8")
    page = Page(text)
    closer = next(attributes for _, attributes in page.tags if attributes.get("id") == "close")
    assert "hidden" in closer, "what needs a script is shown by it"
    drawn = [of["aria-label"] for of in page.all("svg") if "aria-label" in of]
    assert {"When observation and model differ", "One run replayed"} <= set(drawn)


def test_the_browser_hears_what_goes_wrong(browser, tmp_path):
    page = tmp_path / "wrong.html"
    page.write_text(
        "<!doctype html><title>wrong</title><img src='http://127.0.0.1:9/none.png'>"
        "<script>console.warn('beware'); nothing.at.all;</script>"
    )
    browser.open(page)
    said = "\n".join(browser.complaints())
    assert "beware" in said and "nothing is not defined" in said, said
    assert browser.requests() == [page.as_uri(), "http://127.0.0.1:9/none.png"]
