"""The pages of findings in a browser, headless Chromium: filters, sorting, the map, copying, keyboard, narrow
screens, dark ones, hostile names, and nothing that the console complains of. Skipped (exit code 77) without Chromium.
Arguments: the program, sample_pages. PAGES_SCREENSHOTS: a folder to keep pictures in."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SAMPLE, PROGRAM = os.path.abspath(sys.argv.pop()), os.path.abspath(sys.argv.pop())
ROWS = 700
TRACERS = ("woop_watertight_f32", "moller_trumbore_f64")

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError:
    print("skipped: no python3-selenium; cmake/install-dependencies browser")
    sys.exit(77)
CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
if not CHROMIUM or not DRIVER:
    print("skipped: no Chromium; cmake/install-dependencies browser")
    sys.exit(77)


def start_browser(profile):
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--force-device-scale-factor=1", "--disable-background-networking", f"--user-data-dir={profile}"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(DRIVER), options=options)


def run(*command):
    subprocess.run(command, check=True, capture_output=True)


def setUpModule():
    """One browser for all, and two sets of pages: `found` by two small campaigns, and `sample`."""
    global browser, found, sample, scratch
    scratch = tempfile.TemporaryDirectory()
    folder = pathlib.Path(scratch.name)
    found, sample = folder / "found", folder / "sample"
    sample.mkdir()
    campaigns = []
    for tracer in TRACERS:
        campaigns.append(folder / tracer)
        run(PROGRAM, "fuzz", "--tracer", tracer, "--runs", "5000", "-o", campaigns[-1])
    run(PROGRAM, "triage", "html", *campaigns, "-o", found, "--pages", "8")
    run(SAMPLE, sample, str(ROWS))
    browser = start_browser(folder / "profile")


def tearDownModule():
    browser.quit()
    scratch.cleanup()


class PagesTest(unittest.TestCase):
    def setUp(self):
        self.screen(1280, 900)
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def tearDown(self):
        """Whatever a test did: the console is silent, and no name was run as a program."""
        self.assertEqual([entry["message"] for entry in browser.get_log("browser")], [])

    def scheme(self, name):
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                {"features": [{"name": "prefers-color-scheme", "value": name}]})

    def screen(self, width, height):
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def open(self, folder, page="index.html", asked=""):
        browser.get("about:blank")  # or else another '#' alone loads nothing
        browser.get((folder / page).as_uri() + asked)

    def one(self, selector):
        return browser.find_element(By.CSS_SELECTOR, selector)

    def texts(self, selector):
        return browser.execute_script(
            "return [...document.querySelectorAll(arguments[0])].map(e => e.textContent)", selector)

    def column(self, title):
        """The cells of a column of the list as they are shown."""
        titles = self.texts("#list thead th")
        return self.texts(f"#list tbody td:nth-child({titles.index(title) + 1})")

    def shown(self):
        return self.one("#shown").text

    def asked(self):
        return browser.execute_script("return decodeURIComponent(location.hash)")

    def picture(self, name):
        folder = os.environ.get("PAGES_SCREENSHOTS")
        if folder:
            browser.save_screenshot(str(pathlib.Path(folder) / (name + ".png")))

    def finding_pages(self, folder):
        return sorted(p.name for p in folder.glob("finding-*.html"))


class List(PagesTest):
    def test_shows_the_first_rows_and_more(self):
        self.open(sample)
        total = ROWS + 9  # hostile names
        self.assertEqual(self.shown(), f"{total} findings; the first 200 are shown")
        self.assertEqual(len(self.texts("#list tbody tr")), 200)
        self.one("#more").click()
        self.assertEqual(self.shown(), f"{total} findings; the first 400 are shown")
        for _ in range(2):
            self.one("#more").click()
        self.assertEqual(len(self.texts("#list tbody tr")), total)
        self.assertEqual(self.shown(), f"{total} findings")
        self.assertFalse(self.one("#more").is_displayed())
        self.assertEqual(len(self.texts("#list tbody a")), 9 + 3)  # these alone have pages

    def test_filters(self):
        self.open(sample)
        Select(self.one("#tracer")).select_by_visible_text("tracer_7")
        self.assertEqual(set(self.column("Tracer")) - {"tracer_7 new"}, {"tracer_7"})
        of_tracer = len(self.texts("#list tbody tr"))
        Select(self.one("#kind")).select_by_visible_text("false-miss")
        self.assertEqual(set(self.column("Kind")), {"false-miss"})
        self.assertLess(len(self.texts("#list tbody tr")), of_tracer)
        self.assertEqual(self.asked(), "#tracer=tracer_7&kind=false-miss")
        Select(self.one("#conditioning")).select_by_visible_text("sliver")
        Select(self.one("#status")).select_by_visible_text("wontfix")
        self.assertLessEqual(set(self.column("Status")), {"wontfix"})
        self.one("#reset").click()
        self.assertEqual((self.asked(), self.shown().split()[0]), ("", str(ROWS + 9)))
        self.one("#fresh").click()
        self.assertTrue(all(cell.endswith(" new") for cell in self.column("Tracer")))
        self.one("#fresh").click()
        self.one("#text").send_keys("death-bc")
        self.assertTrue(self.column("Signature"))
        self.assertTrue(all("death-bc" in cell for cell in self.column("Signature")))
        self.one("#text").clear()
        self.one("#text").send_keys("17")
        self.assertIn("17", self.column("No."))
        self.one("#text").send_keys(" and no other")
        self.assertEqual(self.shown(), "None of the findings is like that.")

    def test_sorts_by_any_column_and_back(self):
        self.open(sample, asked="#kind=displaced")
        first = self.column("No.")
        for title, key in (("Tracer", lambda cell: cell.removesuffix(" new")), ("Seen", int), ("Simplest, bits", int),
                           ("First seen", str), ("No.", int)):
            with self.subTest(title):
                buttons = browser.find_elements(By.CSS_SELECTOR, "#list th button")
                header = next(b for b in buttons if b.text.startswith(title))
                number = int(header.find_element(By.XPATH, "..").get_attribute("cellIndex") or 0)
                header.click()
                cells = [key(cell) for cell in self.column(title)]
                self.assertEqual(cells, sorted(cells))
                sorts = browser.execute_script(
                    "return [...document.querySelectorAll('#list th')].map(e => e.ariaSort)")
                self.assertEqual(sorts[number], "ascending")
                self.assertEqual(sum(s is not None for s in sorts), 1)
                browser.switch_to.active_element.send_keys(Keys.ENTER)  # the keyboard stays where it was
                cells = [key(cell) for cell in self.column(title)]
                self.assertEqual(cells, sorted(cells, reverse=True))
        self.open(sample, asked="#kind=displaced")
        self.assertEqual(self.column("No."), first)

    def test_the_map_filters(self):
        self.open(found)
        cell = self.one("#map button")
        label, count = cell.get_attribute("aria-label"), int(cell.text)
        tracer, condition = label.split(":")[0].split(", ")
        cell.send_keys(Keys.SPACE)
        self.assertEqual(len(self.texts("#list tbody tr")), count)
        self.assertEqual(set(self.column("Tracer")), {tracer})
        self.assertEqual(set(self.column("Condition")), {condition})
        self.assertEqual(self.one("#map button[aria-pressed=true]").get_attribute("aria-label"), label)
        self.assertEqual(browser.switch_to.active_element.get_attribute("aria-label"), label)
        browser.switch_to.active_element.click()  # again: all
        self.assertEqual(self.asked(), "")
        self.assertEqual(sum(map(int, self.texts("#map td"))), int(self.shown().split()[0]))

    def test_the_address_keeps_what_is_asked(self):
        self.open(sample, asked="#tracer=tracer_3&sort=count&down=1")
        counts = list(map(int, self.column("Seen")))
        self.assertEqual(counts, sorted(counts, reverse=True))
        self.assertEqual(Select(self.one("#tracer")).first_selected_option.text, "tracer_3")
        browser.execute_script("location.hash = 'kind=displaced'")
        WebDriverWait(browser, 10).until(lambda _: set(self.column("Kind")) == {"displaced"})
        for nonsense in ("#sort=nothing", "#%", "#<img src=x onerror=alert(1)>", "#__proto__=1"):
            self.open(sample, asked=nonsense)
            self.assertTrue(self.shown().startswith(f"{ROWS + 9} findings"), nonsense)
        self.open(sample, asked="#tracer=%3Cscript%3E")
        self.assertEqual(self.shown(), "None of the findings is like that.")

    def test_hostile_names_are_names(self):
        self.open(sample, asked="#sort=rank")
        names = self.texts("#list tbody tr td:nth-child(2)")[:9]
        for name in ("<script>alert(1)</script>", "'; DROP TABLE findings; --", "\"quotes\" & 'more' <b>", "{{data}}",
                     "two\nlines"):
            self.assertIn(name, names)
            browser.execute_script("""const s = document.getElementById('tracer'); s.value = arguments[0];
                                      s.dispatchEvent(new Event('change'));""", name)
            self.assertEqual(self.column("Tracer"), [name])
            browser.get(browser.current_url)
            browser.refresh()  # by the address alone
            self.assertEqual(self.column("Tracer"), [name])

    def test_what_was_searched_is_told(self):
        self.open(found)
        said = self.one("main").text
        self.assertIn("Searched: 2 searches, 10 000 executions, of 2 tracers.", said)
        self.assertIn("fuzz: space ray, domain nominal, seed 1", said)
        self.picture("list")

    def test_links_lead_to_pages_and_back(self):
        self.open(found)
        link = self.one("#list tbody a")
        number = link.text
        link.click()
        self.assertIn(f"finding-{number}.html", browser.current_url)
        self.assertIn(f"Finding {number}", self.one("main").text)
        self.one("nav.pages a").click()
        self.assertIn("index.html", browser.current_url)


class Finding(PagesTest):
    def test_every_page_opens_whole(self):
        for folder in (found, sample):
            for page in self.finding_pages(folder):
                with self.subTest(page=page):
                    self.open(folder, page)
                    self.assertEqual(len(self.texts("h1")), 1)
                    self.assertTrue(self.texts("#case-text")[0].strip())
                    self.tearDown()

    def test_pictures_hold_what_they_label(self):
        """All text of a drawing lies within it."""
        for page in self.finding_pages(found):
            self.open(found, page)
            self.assertTrue(self.texts("svg"))
            outside = browser.execute_script("""
                const drawings = [...document.querySelectorAll('svg')];
                return drawings.flatMap(svg => [...svg.querySelectorAll('text')].filter(text => {
                  const inner = text.getBoundingClientRect(), outer = svg.getBoundingClientRect();
                  return inner.left < outer.left - 2 || inner.right > outer.right + 2 || inner.top < outer.top - 2 ||
                         inner.bottom > outer.bottom + 2;
                }).map(text => text.textContent));""")
            self.assertEqual(outside, [], page)
        self.picture("finding")

    def test_copies(self):
        browser.execute_cdp_cmd("Browser.grantPermissions",
                                {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]})
        page = self.finding_pages(found)[0]
        self.open(found, page)
        browser.execute_script("for (const more of document.querySelectorAll('details')) more.open = true")
        for button in browser.find_elements(By.CSS_SELECTOR, "button.copy"):
            wanted = self.texts("#" + button.get_attribute("data-copy"))[0]
            button.send_keys(Keys.ENTER)
            WebDriverWait(browser, 10).until(lambda _: button.text == "Copied")
            copied = browser.execute_async_script("navigator.clipboard.readText().then(arguments[0])")
            self.assertEqual(copied, wanted)
            self.assertEqual(self.one("#said").get_attribute("textContent"), "Copied")
        self.assertIn("plumbline replay", browser.find_element(By.ID, "replay").text)

    def test_what_is_copied_runs(self):
        for page in self.finding_pages(found)[:3]:
            self.open(found, page)
            for block in self.texts("#explain-worst") + self.texts("#replay"):
                self.assertTrue(block.startswith("plumbline "))
                done = subprocess.run(["bash", "-c", 'plumbline() { "$PROGRAM" "$@"; }; ' + block], cwd=found,
                                      capture_output=True, text=True, env={**os.environ, "PROGRAM": PROGRAM})
                self.assertEqual(done.returncode, 0, block + done.stderr)

    def test_repros_of_hostile_tracers(self):
        self.open(sample, f"finding-{ROWS + 1}.html")
        self.assertEqual(self.texts("#repro-python-proof"), ["python-proof for <script>alert(1)</script>"])
        self.assertEqual(len(self.texts("[id^=repro-]")), 12)


class Screens(PagesTest):
    def pages(self):
        return [(sample, "index.html"), (found, "index.html"), (sample, f"finding-{ROWS + 1}.html"),
                *((found, page) for page in self.finding_pages(found)[:6])]

    def test_narrow_ones_need_no_scrolling_sideways(self):
        self.screen(360, 800)
        for folder, page in self.pages():
            self.open(folder, page)
            browser.execute_script("for (const d of document.querySelectorAll('details')) d.open = true")
            width = browser.execute_script("return document.documentElement.scrollWidth")
            self.assertLessEqual(width, 360, page)
            self.picture("narrow-" + page)

    def contrasts(self):
        """Of every text that is seen, the least ratio of luminances to what is behind it (WCAG 2.1)."""
        return browser.execute_script("""
          const channel = (c) => (c /= 255) <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
          const luminance = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
          const numbers = (text) => text.match(/[\\d.]+/g).map(Number);
          const behind = (e) => {
            for (; e; e = e.parentElement) {
              const [r, g, b, a = 1] = numbers(getComputedStyle(e).backgroundColor);
              if (a > 0) return [r, g, b];
            }
            return [255, 255, 255];
          };
          const seen = [];
          const all = 'p, td, th, dt, dd, a, button, summary, span, figcaption, pre, h1, h2';
          for (const e of document.querySelectorAll(all)) {
            if (!e.textContent.trim() || !e.getClientRects().length) continue;
            const [x, y] = [luminance(numbers(getComputedStyle(e).color)), luminance(behind(e))];
            seen.push([(Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05), e.textContent.slice(0, 40)]);
          }
          return seen.sort((p, q) => p[0] - q[0])[0];""")

    def test_light_and_dark_are_legible(self):
        papers = set()
        for scheme in ("light", "dark"):
            self.scheme(scheme)
            for folder, page in self.pages()[1:4]:
                self.open(folder, page)
                ratio, text = self.contrasts()
                self.assertGreaterEqual(ratio, 4.5, f"{scheme} {page}: {text}")
                papers.add(browser.execute_script("return getComputedStyle(document.body).backgroundColor"))
                self.picture(f"{scheme}-{page}")
        self.assertEqual(len(papers), 2)

    def test_the_shades_of_the_map_differ_in_grey(self):
        for scheme in ("light", "dark"):
            self.scheme(scheme)
            self.open(found)
            greys = browser.execute_script("""
              return [...document.querySelectorAll('#legend span')].map(e => {
                const [r, g, b] = getComputedStyle(e).backgroundColor.match(/\\d+/g).map(Number);
                return 0.299 * r + 0.587 * g + 0.114 * b;
              });""")
            self.assertEqual(len(greys), 5)
            steps = [y - x for x, y in zip(greys, greys[1:])]
            self.assertTrue(all(s < -20 for s in steps) or all(s > 20 for s in steps), greys)

    def test_the_keyboard_reaches_all_and_is_seen(self):
        self.open(found)
        browser.switch_to.active_element.send_keys(Keys.TAB)
        self.assertEqual(browser.switch_to.active_element.text, "Skip to the findings")
        browser.switch_to.active_element.send_keys(Keys.ENTER)
        self.assertEqual(browser.execute_script("return document.activeElement.id"), "findings")
        self.assertGreater(len(self.texts("#list tbody tr")), 0)
        browser.switch_to.active_element.send_keys(Keys.TAB)
        self.assertEqual(browser.execute_script("return document.activeElement.id"), "text")
        outline = browser.execute_script("return getComputedStyle(document.activeElement).outlineStyle")
        self.assertEqual(outline, "solid")
        unnamed = browser.execute_script("""
          return [...document.querySelectorAll('input, select, button, a, [role=region]')].filter(
            e => !(e.ariaLabel || e.textContent.trim() || e.labels?.length)).map(e => e.outerHTML)""")
        self.assertEqual(unnamed, [])

    def test_print_hides_what_can_only_be_clicked(self):
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print", "features": []})
        self.open(found, self.finding_pages(found)[0])
        hidden = browser.find_elements(By.CSS_SELECTOR, "button.copy, nav.pages")
        self.assertTrue(hidden)
        self.assertFalse(any(e.is_displayed() for e in hidden))
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})

    def test_nothing_is_fetched(self):
        for folder, page in self.pages()[:3]:
            self.open(folder, page)
            fetched = browser.execute_script("return performance.getEntriesByType('resource').map(e => e.name)")
            self.assertEqual([name for name in fetched if not name.startswith("data:")], [])


if __name__ == "__main__":
    unittest.main()
