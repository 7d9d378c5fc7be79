"""Renders a report as a picture: doc/picture.py CORPUSCLE OUT.png ARGUMENTS..., with the arguments of `corpuscle respond`: force and spikes.

doc/picture.py CORPUSCLE OUT.png study NAME TEXT: those plots of a study whose title contains TEXT, in two columns."""

import pathlib
import subprocess
import sys
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

FLAGS = ("--headless=new --no-sandbox --disable-gpu --disable-quic --no-first-run --hide-scrollbars --force-device-scale-factor=1.6 "
         "--disable-background-networking --disable-component-update --disable-sync --window-size=1000,2600").split()


RESPONSE = """
    const sections = [...document.querySelectorAll('#figures > section')];
    const skin = document.querySelector('#maps') !== null;
    for (const other of skin ? sections.slice(1, -1) : document.querySelectorAll('#figures > details, #figures .hint, #first h2')) other.remove();  // without currents and membranes
    document.querySelectorAll('.menu').forEach((menu) => menu.remove());
    document.querySelector('#figures').style.padding = '0 12px';
    // the maps and the figures below them, in one picture
    for (const other of document.querySelectorAll('main > *')) other.hidden = skin && !['maps', 'figures'].includes(other.id);
    for (const hint of document.querySelectorAll('#maps .bar')) hint.hidden = skin;"""

STUDY = """
    const kept = [...document.querySelectorAll('figure')].filter((one) => one.querySelector('figcaption').textContent.includes(arguments[0]));
    document.querySelector('main').replaceChildren(...kept);
    const rows = Math.ceil(kept.length / 2);  // the first half of the plots is in the left column
    document.querySelector('main').style = `display: grid; grid: repeat(${rows}, auto) / auto-flow minmax(0, 1fr); gap: 12px; padding: 12px; width: 970px`;
    for (const one of kept) one.style = 'margin: 0; width: auto';
    for (const key of [...document.querySelectorAll('.key')].slice(1)) key.remove();
    for (const plot of document.querySelectorAll('.plot')) plot.style.height = '190px';
    for (const chart of window.charts) if (kept.some((one) => one.contains(chart.graphDiv))) chart.resize();"""


def main(corpuscle, picture, *arguments):
    study = arguments[0] == "study"
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.html"
        command = ["study", arguments[1]] if study else ["respond", *arguments]
        subprocess.run([corpuscle, *command, "--report", report, "--quiet"], check=True)
        options = Options()
        options.binary_location = "/usr/bin/chromium"
        for flag in [*FLAGS, f"--user-data-dir={folder}/profile"]:
            options.add_argument(flag)
        browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        try:
            browser.get(report.as_uri())
            browser.execute_script(STUDY if study else RESPONSE, *arguments[2:3])
            browser.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")
            shown = browser.find_elements(By.CSS_SELECTOR, "main:has(#maps)" if not study else "main") or browser.find_elements(By.ID, "figures")
            if not shown[0].screenshot(picture):
                sys.exit(f"{picture} cannot be written")
        finally:
            browser.quit()


if __name__ == "__main__":
    main(*sys.argv[1:])
