#!/usr/bin/python3
"""Tests of the pages of `corpuscle study` and `corpuscle fit transistor` (see browser.py)."""
from page_checks import *

DEVIATING, AGREEING = ("differs", "does not hold"), ("agrees", "holds")
STUDIES = ["fig16", "kim", "fig13", "table13"]


class Studies(Pages):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.path = OUT / "studies.html"
        subprocess.run([CORPUSCLE, "study", *STUDIES, "--report", str(cls.path), "--quiet"], check=True)
        cls.data = data_of(cls.path)
        cls.claims = [(study["name"], claim) for study in cls.data["studies"] for claim in study["claims"]]

    def study(self, name):
        return next(one for one in self.data["studies"] if one["name"] == name)

    def rows(self, selector="#claims"):
        """The rows of a table of claims: the texts of their cells."""
        return self.js("return [...document.querySelectorAll(`${arguments[0]} tbody tr`)].map((row) => [...row.cells].map((one) => one.textContent))", selector)

    def test_each_study_has_a_card_with_a_picture_and_its_verdicts_in_words(self):
        self.open(self.path)
        cards = self.all(".card")
        self.assertEqual([card.get_attribute("id") for card in cards], [one["name"] for one in self.data["studies"]])
        for card, study in zip(cards, self.data["studies"]):
            text = card.text.replace("\u00a0", " ")
            self.assertIn(study["title"], text)
            good, bad = (sum(claim["verdict"] in verdicts for claim in study["claims"]) for verdicts in (AGREEING, DEVIATING))
            for count, words in ((good, "✓ {} hold"), (bad, "✗ {} differ")):
                self.assertEqual(words.format(count) in text, count > 0, (study["name"], text))
        colours = self.js("""return [...document.querySelectorAll("canvas.thumbnail")].map((canvas) => {
            const pixels = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer); return new Set(pixels).size; })""")
        self.assertEqual(len(colours), len(self.data["studies"]))
        self.assertGreater(min(colours), 5)
        self.assertLess(cards[0].location["y"], 320)  # on the first screen

    def test_a_card_opens_its_figures_and_claims_and_closes_them(self):
        self.open(self.path)
        self.assertEqual(self.all(".opened"), [])
        self.browser.find_element(By.CSS_SELECTOR, "#fig13 .open").click()
        self.settle()
        study = self.study("fig13")
        self.assertEqual(self.panels(), [f"fig13: {plot['title']}" for plot in study["plots"]])
        for name, plot in zip(self.panels(), study["plots"]):
            self.assertEqual(self.drawn_points(name), sum(len(floats(one["x"])) for one in plot["series"]))
        self.assertEqual(len(self.rows(".opened")), len(study["claims"]))
        self.until(lambda: self.browser.current_url.endswith("#fig13"))
        self.assertEqual(self.browser.find_element(By.CSS_SELECTOR, "#fig13 .open").get_attribute("aria-expanded"), "true")
        self.js("document.querySelector('.opened .close').click()")
        self.assertEqual((self.all(".opened"), self.panels()), ([], []))
        self.until(lambda: "#" not in self.browser.current_url)

    def test_a_link_opens_its_study_and_a_damaged_link_is_ignored(self):
        self.open(self.path, "#kim")
        self.assertEqual([one.get_attribute("data-study") for one in self.all(".opened")], ["kim"])
        self.js("document.querySelector('#claims a[href=\"#fig16\"]').click()")
        self.until(lambda: len(self.all(".opened")) == 2)
        for link in ("#nosuch", "#%%%", "#<img>", "#fig16&x=%E0%A4%A", "#" + "a" * 5000):
            self.open(self.path, link)
            self.assertEqual(self.all(".opened"), [], link)
            self.assertEqual(len(self.all(".card")), len(self.data["studies"]))

    def test_the_table_has_each_claim_once_and_can_be_filtered(self):
        self.open(self.path)
        names = [[study, claim["label"]] for study, claim in self.claims]
        shown = lambda: [row[0] for row in self.rows()]
        cards = lambda: [one.get_attribute("id") for one in self.all(".card") if one.is_displayed()]
        self.assertEqual(shown(), [study for study, _ in names])
        self.assertEqual(len(self.rows()), len(self.claims))
        self.browser.find_element(By.ID, "differs").click()
        deviating = [study for study, claim in self.claims if claim["verdict"] in DEVIATING]
        self.assertEqual(shown(), deviating)
        self.assertEqual(cards(), list(dict.fromkeys(deviating)))
        self.assertGreater(len(deviating), 0)
        self.assertLess(len(deviating), len(names))
        self.browser.find_element(By.ID, "differs").click()
        menu = Select(self.browser.find_element(By.ID, "kind"))
        self.assertGreater(len(menu.options), 2)
        for kind in [option.text for option in menu.options[1:]]:
            menu.select_by_visible_text(kind)
            self.assertEqual(shown(), [study for study, claim in self.claims if claim["verdict"] and claim["kind"] == kind], kind)
        menu.select_by_visible_text("all")
        self.browser.find_element(By.ID, "search").send_keys("FIG1 transconductance")
        self.assertEqual(cards(), ["fig13"])
        self.assertEqual(set(shown()), {"fig13"})
        self.assertEqual(self.browser.find_element(By.ID, "shown").text, "1 of 4 studies")

    def test_the_table_of_claims_is_sorted_by_value_and_saved_as_it_is_shown(self):
        self.open(self.path)
        head = self.texts_of("#claims thead th")
        column = head.index("deviation")
        self.js("document.querySelectorAll('#claims thead button')[arguments[0]].click()", column)
        expected = sorted((claim["deviation"] for _, claim in self.claims if claim["deviation"] is not None))
        self.assertEqual(self.all("#claims th[aria-sort=ascending]")[0].text, "deviation")
        texts = [row[column] for row in self.rows()][:len(expected)]
        values = [float(text.replace(" %", "").replace("+", "").replace("−", "-")) for text in texts]
        self.assertEqual(values, sorted(values))
        self.assertGreater(len(set(values)), 5)
        self.js("document.querySelector('#claims .save').click()")
        file = self.files / "claims-of-all-studies.csv"
        self.until(lambda: file.exists() and file.stat().st_size > 0)
        rows = list(csv.DictReader(file.read_text().splitlines()))
        self.assertEqual([float(row["deviation"]) for row in rows if row["deviation"]], expected)
        self.assertEqual(sorted((row["study"], row["claim"]) for row in rows), sorted((study, claim["label"]) for study, claim in self.claims))
        file.unlink()

    def test_the_kinds_of_claims_are_counted(self):
        self.open(self.path)
        groups = [(group, verdict) for group in ("printed", "derived", "statements") for verdict in ("agreeing", "deviating")]
        self.assertEqual([row[1:7] for row in self.rows("#kinds")], [[str(kind[group][verdict]) for group, verdict in groups] for kind in self.data["kinds"]])

    def test_a_curve_can_be_hidden_zoomed_and_read(self):
        self.open(self.path, "#fig13")
        name = self.panels()[1]
        plot, (a, b) = self.plot(name), self.view(name)
        before = self.drawn_points(name)
        self.js("document.querySelectorAll(`[data-panel=${JSON.stringify(arguments[0])}] button.legend-item`)[0].click()", name)
        self.until(lambda: self.drawn_points(name) < before)
        self.js("document.querySelectorAll(`[data-panel=${JSON.stringify(arguments[0])}] button.legend-item`)[0].click()", name)
        self.until(lambda: self.drawn_points(name) == before)
        ActionChains(self.browser, duration=50).move_to_element_with_offset(plot, -60, 0).click_and_hold().move_by_offset(60, 0).move_by_offset(60, 0).release().perform()
        self.until(lambda: self.view(name)[1] - self.view(name)[0] < (b - a) / 2)
        x, y = self.js("const p = corpuscle.panels[arguments[0]], [c] = p.placed; return [p.x(c.x[300]) - p.plot.clientWidth / 2, p.y(c.y[300]) - p.plot.clientHeight / 2]", name)
        ActionChains(self.browser, duration=50).move_to_element_with_offset(plot, round(x), round(y)).perform()
        tip = self.until(lambda: self.js("const tip = corpuscle.panels[arguments[0]].plot.querySelector('.tip'); return tip.style.display === 'block' && tip.textContent", name))
        self.assertIn("V_+ - V_-", tip)
        self.assertIn("pA", tip)
        self.js("corpuscle.panels[arguments[0]].plot.focus()", name)
        ActionChains(self.browser).send_keys("0").perform()
        self.until(lambda: self.view(name) == [a, b])
        box = plot.rect
        wheel = {"type": "mouseWheel", "x": self.js("return arguments[0].getBoundingClientRect().x", plot) + box["width"] / 2, "y": self.js("return arguments[0].getBoundingClientRect().y", plot) + 60, "deltaX": 0, "deltaY": -200}
        self.browser.execute_cdp_cmd("Input.dispatchMouseEvent", wheel)
        self.until(lambda: self.view(name)[1] - self.view(name)[0] < b - a)

    def test_the_files_of_a_figure_have_its_numbers(self):
        self.open(self.path, "#fig13")
        name, plot = self.panels()[0], self.study("fig13")["plots"][0]
        rows = list(csv.reader(self.saved(name, "CSV").decode().splitlines()))
        self.assertEqual(rows[0], ["series", plot["x"], plot["y"]])
        expected = [[one["name"], x, y] for one in plot["series"] for x, y in zip(floats(one["x"]), floats(one["y"]))]
        self.assertEqual([row[0] for row in rows[1:]], [name for name, _, _ in expected])
        for row, (_, x, y) in zip(rows[1:], expected):
            self.assertTrue(math.isclose(float(row[1]), x, rel_tol=1e-6) and math.isclose(float(row[2]), y, rel_tol=1e-6), (row, x, y))
            self.assertLess(max(len(row[1]), len(row[2])), 15)  # no digits beyond single precision
        svg = self.saved(name, "SVG").decode()
        self.assertIn("</svg>", svg)
        self.assertGreaterEqual(svg.count("<path"), len(plot["series"]))
        png = self.saved(name, "PNG")
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        size = self.js("const {canvas} = corpuscle.panels[arguments[0]]; return [canvas.width, canvas.height]", name)
        self.assertEqual([int.from_bytes(png[k:k + 4], "big") for k in (16, 20)], size)

    def test_it_fits_every_screen_and_a_claim_is_a_few_lines_high_on_a_phone(self):
        self.assert_it_fits(self.path, "#fig13", "studies")
        for width in (360, 390):
            self.open(self.path, "#fig13", width, 844)
            boxes = self.js("""return [...document.querySelectorAll("tbody tr, tbody tr .reason")].filter((one) => one.offsetHeight).map((one) => {
                const {right, height} = one.getBoundingClientRect(); return [right, height]; })""")
            self.assertLessEqual(max(right for right, _ in boxes), width)
            self.assertLess(max(height for _, height in boxes), 300)
            sideways = self.js("return [...document.querySelectorAll('.scroll')].filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.textContent.slice(0, 60))")
            self.assertEqual(sideways, [])

    def test_colours_have_contrast(self):
        self.assert_contrast(self.path)

    def test_pictures_and_figures_follow_a_change_of_the_theme(self):
        self.open(self.path, "#fig13")
        ink = """return [document.querySelector(".thumbnail"), corpuscle.panels[Object.keys(corpuscle.panels)[0]].canvas].map((canvas) => {
            const counts = {}, pixels = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
            for (const one of pixels) if (one) counts[one] = (counts[one] || 0) + 1;
            return Number(Object.entries(counts).sort((a, b) => b[1] - a[1])[0][0]); })"""
        light = self.js(ink)
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        self.until(lambda: all(one != other for one, other in zip(light, self.js(ink))))

    def test_a_single_study_is_open(self):
        path = OUT / "one_study.html"
        subprocess.run([CORPUSCLE, "study", "kim", "--report", str(path), "--quiet"], check=True)
        self.open(path)
        study = data_of(path)["studies"][0]
        self.assertEqual(len(self.panels()), len(study["plots"]))
        self.assertEqual(len(self.rows("main")), len(study["claims"]))
        self.assertIn("corpuscle study kim", self.browser.find_element(By.ID, "command").text)
        self.assertNotIn(str(OUT), self.browser.find_element(By.ID, "command").text)

    def test_on_paper_each_study_has_its_picture_and_each_table_fits(self):
        self.open(self.path, "#fig13")
        self.assertEqual(cropped_tables(self.browser), [])
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.assertTrue(all(one.is_displayed() for one in self.all(".thumbnail")))
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})

    def test_an_opened_study_is_below_the_bar_on_a_phone(self):
        self.open(self.path, "#fig13", 360, 740)
        bar, study = (self.js("return document.querySelector(arguments[0]).getBoundingClientRect().toJSON()", one) for one in (".toolbar", ".opened"))
        self.assertGreaterEqual(study["top"], bar["bottom"])
        self.assertFalse(self.js("return document.getElementById('claims').open"), "hundreds of claims are folded there")

    def test_on_paper_the_controls_are_gone(self):
        self.open(self.path, "#fig13")
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.assertFalse(any(one.is_displayed() for one in self.all(".toolbar, .menu, .save, .close")))
        self.assertTrue(self.all(".opened figure")[0].is_displayed())
        pdf = base64.b64decode(self.browser.execute_cdp_cmd("Page.printToPDF", {"printBackground": False})["data"])
        self.assertTrue(pdf.startswith(b"%PDF"))
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})

    def test_no_text_of_a_study_becomes_a_script(self):
        def poison(data):
            data["title"] = data["headline"] = PAYLOAD
            for study in data["studies"]:
                study["title"] = study["question"] = PAYLOAD
                study["notes"] = [PAYLOAD]
                for claim in study["claims"]:
                    claim.update({"label": PAYLOAD, "unit": PAYLOAD, "source": PAYLOAD, "note": PAYLOAD, "texts": [PAYLOAD] * 4})
                for plot in study["plots"]:
                    plot.update({"title": PAYLOAD, "x": PAYLOAD, "y": PAYLOAD + " (V)", "published": PAYLOAD})
                    for one in plot["series"]:
                        one["name"] = PAYLOAD

        self.open(with_changed_data(self.path, "poisoned_studies.html", poison), "#fig13")
        self.assertEqual(len(self.all(".opened figure")), 2)
        self.assertIn(PAYLOAD, self.texts_of("h1")[0])
        self.assert_text_stays_text()
        self.assertNotIn("<img", self.saved(self.panels()[0], "SVG").decode())


class FittedTransistor(Pages):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.path = OUT / "transistor.html"
        subprocess.run([CORPUSCLE, "fit", "transistor", str(ROOT / "examples/data/nmos.raw"), "-W", "1.5u", "-L", "0.5u", "--report", str(cls.path), "--quiet"], check=True)
        cls.data = data_of(cls.path)

    def test_it_shows_all_values_and_curves_with_one_legend_for_points_and_line_of_a_curve(self):
        self.open(self.path)
        rows = self.js("return [...document.querySelectorAll('tbody tr')].map((row) => [...row.cells].map((one) => one.textContent))")
        self.assertEqual([row[1:4] for row in rows], [[one["card"], one["text"], one["interval"]] for one in self.data["fit"]["parameters"]])
        self.assertEqual(len(self.panels()), 6)
        for name, plot in zip(self.panels(), self.data["plots"]):
            self.assertEqual(self.drawn_points(name), sum(len(floats(one["x"])) for one in plot["series"]), name)
        keys = self.all("figure:first-child .legend-item")
        self.assertEqual(len(keys), len(self.data["plots"][0]["series"]) / 2)
        before = self.drawn_points(self.panels()[0])
        keys[0].click()
        hidden = sum(len(floats(one["x"])) for one in self.data["plots"][0]["series"][:2])
        self.until(lambda: self.drawn_points(self.panels()[0]) == before - hidden)

    def test_it_fits_every_screen(self):
        self.assert_it_fits(self.path, "", "transistor")


if __name__ == "__main__":
    run_tests()
