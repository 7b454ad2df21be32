"""The report in a real browser: Debian's chromium, headless, from the file system."""

import shutil

import pytest

selenium = pytest.importorskip("selenium", reason="selenium is not installed")
CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
pytestmark = pytest.mark.skipif(
    not (CHROMIUM and DRIVER), reason="no chromium with its driver here: apt-get install chromium chromium-driver"
)
OPTIONS = [
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-dev-shm-usage"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
]
PAGES = ("index.html", "deon2016.html", "dupuy2016.html", "deon2021.html", "tokuyoshi_harada.html", "kenha2018.html",
         "xsec.html", "table1.html", "charts.html", "errata-deon2016.html", "reference.html")  # fmt: skip


class Browser:
    """The driver, and every request that the pages made."""

    def __init__(self, profile, folder):
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service

        options = webdriver.ChromeOptions()
        for option in (*OPTIONS, f"--user-data-dir={profile}"):
            options.add_argument(option)
        options.binary_location = CHROMIUM
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(DRIVER))
        self.folder = folder
        self.run = self.driver.execute_script

    def look(self, width=1280, height=900, scheme="light"):
        self.driver.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600},
        )
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})

    def open(self, page, **how):
        self.look(**how)
        self.driver.get("about:blank")
        self.driver.get_log("performance")
        self.driver.get(f"{self.folder.as_uri()}/{page}")

    def requests(self):
        import json

        messages = [json.loads(m["message"])["message"] for m in self.driver.get_log("performance")]
        return [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]

    def find(self, selector):
        return self.driver.find_element("css selector", selector)

    def count(self, selector):
        return self.run(
            "return [...document.querySelectorAll(arguments[0])].filter(e => e.checkVisibility()).length", selector
        )


@pytest.fixture(scope="session")
def browser(site, tmp_path_factory):
    found = Browser(tmp_path_factory.mktemp("profile"), site.folder)
    yield found
    found.driver.quit()


@pytest.mark.parametrize("page", PAGES)
def test_a_page(browser, page):
    """No noise, no request, every formula set; and nothing hangs over on a phone. One load for all."""
    browser.open(page)
    asked = browser.requests()
    assert asked and all(url.startswith(("file:", "about:", "data:")) for url in asked), asked
    assert browser.driver.get_log("browser") == []
    assert browser.run("return document.styleSheets.length") == 1
    browser.run("document.querySelectorAll('img').forEach(i => i.scrollIntoView())")
    assert browser.run("return [...document.images].every(i => i.complete && i.naturalWidth > 0)")
    browser.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    if page not in ("index.html", "charts.html", "reference.html"):
        flat = browser.run("""
            return [...document.querySelectorAll("math")].filter((m) => m.checkVisibility()).filter((m) => {
                const box = m.getBoundingClientRect();
                return box.width < 3 || box.height < 3 || m.querySelector("merror");
            }).length;""")
        assert flat == 0 and browser.count("math") > 20
    browser.look(width=375, height=740)
    wide, here = browser.run("return [document.documentElement.scrollWidth, innerWidth]")
    assert wide <= here == 375
    # a name stands above what it names, without a gap
    assert (
        browser.run("return Math.max(0, ...[...document.querySelectorAll('.facts dt')].map((e) => e.offsetHeight))")
        < 60
    )
    assert browser.driver.get_log("browser") == []


def test_requests_would_be_refused_and_seen(browser):
    """The policy holds, and the tests above can fail."""
    browser.open("index.html")
    browser.run("document.body.append(Object.assign(document.createElement('img'), {src: 'http://127.0.0.1:9/a.png'}))")
    said = browser.driver.get_log("browser")
    assert any("Content Security Policy" in line["message"] for line in said)


def test_a_link_leads_to_its_entry_and_opens_its_derivation(browser):
    for width in (1200, 390):
        browser.open("deon2016.html#22", width=width)
        top, shown, open_ = browser.run("""
            const entry = document.getElementById("22"), bar = document.querySelector(".bar").getBoundingClientRect();
            const box = entry.getBoundingClientRect();
            const proof = entry.querySelector("details");
            return [box.top - Math.max(bar.bottom, 0), entry.checkVisibility(), proof.open];""")
        assert 0 <= top < 60 and shown and open_
    assert browser.run("return [...document.querySelectorAll('details[open]')].length") == 1


def test_every_page_is_named_in_the_bar_at_every_width(browser):
    for width in (390, 820, 1200):
        browser.open("index.html", width=width)
        hidden = browser.run("""
            const end = document.querySelector("#theme").getBoundingClientRect().left;
            return [...document.querySelectorAll(".bar a")].map((a) => a.getBoundingClientRect())
                .filter((box) => box.left < 0 || box.right > end).length;""")
        assert hidden == 0


@pytest.mark.parametrize("width", [820, 1200, 1600])
def test_table_1_fits_and_is_large_enough_to_be_read(browser, width):
    browser.open("table1.html", width=width)
    over, cut, small = browser.run("""
        const box = document.querySelector(".scroll");
        const cells = [...document.querySelectorAll(".table1 td, .table1 tbody th")];
        const parts = [...document.querySelectorAll(".table1 td mfrac > *")]
            .filter((m) => !m.closest("msup, msub, msubsup, mfrac mfrac mfrac"));
        return [box.scrollWidth - box.clientWidth, cells.filter((c) => c.scrollWidth > c.clientWidth + 1).length,
                Math.min(...parts.map((m) => parseFloat(getComputedStyle(m).fontSize)))];""")
    assert over <= 0 and cut == 0 and small >= 12
    # every cell says which column it is of, where the head of the table is not shown
    assert browser.count(".table1 thead") == (width == 1600) and (browser.count("td .of") == 40) == (width < 1600)


def test_an_exponent_is_large_enough_to_be_read(browser):
    browser.open("deon2016.html#22")
    assert (
        browser.run("""
        const part = document.querySelector("[id='22'] msup mfrac > *");
        return parseFloat(getComputedStyle(part).fontSize);""")
        > 11
    )


def test_mathematics_is_set_by_the_browser(browser):
    browser.open("deon2016.html#22")
    boxes = browser.run("""
        const math = document.querySelector("[id='22'] .print math:last-of-type");
        const box = (e) => e.getBoundingClientRect();
        const [over, under] = math.querySelector("mfrac").children;
        const root = math.querySelector("msqrt");
        return [math instanceof MathMLElement, box(over).bottom <= box(under).top + 1, box(math).height,
                box(root).width > box(root.firstElementChild).width];""")
    assert boxes[:2] == [True, True] and boxes[2] > 30 and boxes[3]


def test_a_difference_is_seen(browser):
    browser.open("deon2016.html#18")
    colours = browser.run("""
        const article = document.getElementById("18");
        return [".holds .new", ".holds math"].map((s) => getComputedStyle(article.querySelector(s)).color);""")
    assert colours[0] != colours[1]


def test_search_and_filter_on_a_page(browser):
    browser.open("deon2016.html")
    total = browser.count("article.entry")
    browser.find("#search").send_keys("beckmann misprint")
    shown = browser.count("article.entry")
    assert 0 < shown < total
    assert browser.find("#shown").text == f"{shown} of {total} entries shown"
    assert browser.count("[id='22']") == 1 and browser.count("[id='18']") == 0
    browser.find("#search").clear()
    browser.find("#search").send_keys("no such words at all")
    assert browser.count("article.entry") == 0 and browser.find("#nothing").is_displayed()
    # and the filter
    browser.find("#search").clear()
    browser.find("#search").send_keys(" ")
    browser.find("input[value=misprint]").click()
    from xsec_sym.record.store import Ledger

    wrong = [e for e in Ledger().source("deon2016") if e.verdict == "misprint"]
    assert browser.count("article.entry") == len(wrong) == browser.count("article[data-verdict=misprint]")
    browser.find("input[value=definition]").click()
    assert browser.count("article.entry") == len(wrong) + browser.count("article[data-verdict=definition]")
    # a link leads to what the filter hides
    browser.run("location.hash = '#9'")
    browser.driver.implicitly_wait(2)
    assert browser.find("[id='9']").is_displayed()


def test_counts_of_the_index_lead_to_what_they_count(browser):
    browser.open("index.html")
    chip = browser.find("a.count[href='dupuy2016.html?verdict=claim-fails']")
    count = int(chip.text.split()[0])
    chip.click()
    assert browser.count("article.entry") == count == browser.count("article[data-verdict=claim-fails]")


def test_search_over_all_sources_by_keyboard(browser):
    from selenium.webdriver.common.keys import Keys

    browser.open("index.html")
    browser.find("body").send_keys("/")
    field = browser.driver.switch_to.active_element
    assert field.get_attribute("id") == "search"
    field.send_keys("ring lemma")
    assert browser.count("#hits li") > 3
    field.send_keys(Keys.TAB)
    link = browser.driver.switch_to.active_element
    assert link.tag_name == "a"
    link.send_keys(Keys.ENTER)
    assert browser.driver.current_url.partition("#")[0].endswith(("xsec.html", "deon2016.html"))


def test_the_keyboard_reaches_what_can_be_done(browser):
    from selenium.webdriver.common.keys import Keys

    browser.open("kenha2018.html")
    browser.find("body").send_keys(Keys.TAB)
    assert browser.driver.switch_to.active_element.get_attribute("class") == "skip"
    summary = browser.find("details.derivation summary")
    browser.run("arguments[0].focus()", summary)
    summary.send_keys(Keys.ENTER)
    assert browser.find("details.derivation").get_attribute("open")


def test_escape_clears_the_search_and_focus_is_seen(browser):
    from selenium.webdriver.common.keys import Keys

    browser.open("kenha2018.html")
    total = browser.count("article.entry")
    browser.find("body").send_keys("/")
    field = browser.driver.switch_to.active_element
    field.send_keys("no such words")
    assert browser.count("article.entry") == 0
    field.send_keys(Keys.ESCAPE)
    assert browser.count("article.entry") == total and field.get_attribute("value") == ""
    # from the search on: its filters, then what opens all, the sections, the first entry; each with an outline
    reached = []
    for _ in range(25):
        browser.driver.switch_to.active_element.send_keys(Keys.TAB)
        here, outline = browser.run("""
            const e = document.activeElement;
            return [e.name || e.id || e.closest("nav")?.className || e.closest("article")?.tagName || e.tagName,
                    getComputedStyle(e).outlineStyle];""")
        assert outline != "none", here
        reached.append(here)
    order = list(dict.fromkeys(reached))
    assert order[:4] == ["verdict", "unfold", "sections", "ARTICLE"]


def test_only_wide_formulas_are_stops_of_the_keyboard(browser):
    browser.open("deon2021.html", width=375)
    stops, over, all_ = browser.run("""
        const boxes = [...document.querySelectorAll(".formula")];
        return [boxes.filter((b) => b.tabIndex === 0).length, boxes.filter((b) => b.scrollWidth > b.clientWidth).length,
                boxes.length];""")
    assert 0 < stops == over < all_
    # what is a little too wide is set smaller instead, but never so small that it cannot be read
    fits = browser.run(
        "return [...document.querySelectorAll('.formula')].map((b) => b.style.getPropertyValue('--fit'))"
    )
    fits = [float(f) for f in fits if f]
    assert len(fits) > stops and min(fits) == 0.75


def test_code_is_copied(browser):
    browser.driver.execute_cdp_cmd("Browser.grantPermissions", {"permissions": ["clipboardReadWrite"]})
    browser.open("deon2016.html")
    details = browser.find("details.code")
    browser.run("arguments[0].open = true; arguments[0].scrollIntoView()", details)
    wanted = details.find_element("css selector", "code").get_attribute("textContent")
    button = details.find_element("css selector", ".copy")
    browser.run("arguments[0].click()", button)
    browser.driver.implicitly_wait(2)
    found = browser.driver.execute_async_script(
        "const done = arguments[0];"
        "setTimeout(() => navigator.clipboard.readText().then(done, (e) => done(String(e))), 300)"
    )
    assert found.replace("\r\n", "\n") == wanted
    assert button.text == "copied"


def test_light_and_dark(browser):
    ground = "return getComputedStyle(document.body).backgroundColor"
    browser.open("index.html", scheme="light")
    light = browser.run(ground)
    browser.look(scheme="dark")
    assert browser.run(ground) != light
    browser.find("#theme").click()
    assert browser.run(ground) == light
    browser.run("localStorage.clear()")


def test_wide_formulas_show_what_differs_and_fit_on_paper(browser):
    browser.open("errata-deon2016.html", width=700)
    hidden, wide = browser.run("""
        const boxes = [...document.querySelectorAll(".formula")].filter((b) => b.scrollWidth > b.clientWidth);
        const [at, mark] = [(e) => e.getBoundingClientRect(), (b) => b.querySelector(".gone, .new, .gap")];
        const out = (m, b) => m && (at(m).left > at(b).right || at(m).right < at(b).left);
        return [boxes.filter((b) => out(mark(b), b)).length, boxes.length];""")
    assert wide > 2 and hidden == 0
    browser.run("dispatchEvent(new Event('beforeprint'))")
    assert browser.run("return [...document.querySelectorAll('.tiny')].map((b) => b.closest('li').id)") == ["41", "41"]
    browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    over = browser.run("""
        return [...document.querySelectorAll(".formula math")]
            .filter((m) => m.getBoundingClientRect().width > 680).length;""")
    browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert over == 0


@pytest.mark.parametrize("page", ["index.html", "deon2016.html", "errata-deon2021.html"])
def test_text_stands_out_from_its_ground(browser, page):
    browser.open(page)
    for scheme in ("light", "dark"):
        browser.look(scheme=scheme)
        assert browser.run(LEAST) >= 4.5, scheme


LEAST = """
        const numbers = (c) => c.match(/[\\d.]+/g).map(Number);
        const light = (c) => numbers(c).slice(0, 3).map((v) => v / 255)
            .map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
            .reduce((sum, v, k) => sum + v * [0.2126, 0.7152, 0.0722][k], 0);
        const ground = (e) => {
            for (; e; e = e.parentElement) {
                const c = numbers(getComputedStyle(e).backgroundColor);
                if (c.length < 4 || c[3] === 1) return getComputedStyle(e).backgroundColor;
            }
            return "rgb(255, 255, 255)";
        };
        const texts = [...document.querySelectorAll("p, dd, dt, a, h1, h2, h3, .verdict, .chip, mi, mn")];
        return Math.min(...texts.slice(0, 3000)
            .filter((e) => e.checkVisibility())
            .map((e) => [light(getComputedStyle(e).color), light(ground(e))].sort((a, b) => b - a))
            .map(([a, b]) => (a + 0.05) / (b + 0.05)));"""


def test_search_in_the_reference(browser):
    browser.open("reference.html")
    everything = browser.count("article.name")
    browser.find("#search").send_keys("chandrasekhar")
    assert 0 < browser.count("article.name") < everything
    assert "h_isotropic" in browser.run("return document.querySelector('article.name:not([hidden]) h3').textContent")
    browser.find("#search").send_keys(" nothing-of-the-kind")
    assert browser.count("article.name") == 0 and browser.count("#nothing") == 1
