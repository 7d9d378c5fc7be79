"""Renders force and spikes of a report as a picture: doc/picture.py CORPUSCLE OUT.png ARGUMENTS..., with the arguments of `corpuscle respond`."""

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


def main(corpuscle, picture, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.html"
        subprocess.run([corpuscle, "respond", *arguments, "--report", report, "--quiet"], check=True)
        options = Options()
        options.binary_location = "/usr/bin/chromium"
        for flag in [*FLAGS, f"--user-data-dir={folder}/profile"]:
            options.add_argument(flag)
        browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        try:
            browser.get(report.as_uri())
            browser.execute_script("""
                const sections = [...document.querySelectorAll('#figures > section')];
                const skin = document.querySelector('#maps') !== null;
                for (const other of skin ? sections.slice(1, -1) : sections.slice(2)) other.remove();  // without currents and membranes
                document.querySelector('#figures').style.padding = '0 12px';""")
            browser.execute_script("""
                const skin = document.querySelector('#maps') !== null;  // the maps and the figures below them, in one picture
                for (const other of document.querySelectorAll('main > *')) other.hidden = skin && !['maps', 'figures'].includes(other.id);
                for (const hint of document.querySelectorAll('#maps .bar')) hint.hidden = skin;""")
            browser.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")
            shown = browser.find_elements(By.CSS_SELECTOR, "main:has(#maps)") or browser.find_elements(By.ID, "figures")
            if not shown[0].screenshot(picture):
                sys.exit(f"{picture} cannot be written")
        finally:
            browser.quit()


if __name__ == "__main__":
    main(*sys.argv[1:])
