"""Renders a report as a picture: doc/picture.py CORPUSCLE OUT.png ARGUMENTS..., with the arguments of `corpuscle respond`: force and spikes.

doc/picture.py CORPUSCLE OUT.png study NAME TEXT: those plots of a study whose title contains TEXT, in two columns.

doc/picture.py PRESS.html OUT.png: the live page while its skin is pressed."""

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


# The force, spikes and rates of a response, or the maps and figures of a skin.
RESPONSE = """
    document.querySelectorAll('.menu, .hint, .toolbar, details.fold').forEach((one) => one.remove());
    const isSkin = document.querySelector('#maps') !== null, kept = isSkin ? ['maps', 'plots'] : ['figures'];
    for (const other of document.querySelectorAll('main > *')) other.hidden = !kept.includes(other.id);
    document.querySelector('main').style.padding = '0 12px';
    if (isSkin) {
        const {view} = corpuscle;
        document.querySelectorAll('.bar .chooser, .bar .buttons').forEach((one) => one.remove());
        view.point(view.begin + 0.45 * (view.end - view.begin));  // the maps show the middle
    }"""

# The plots of a study whose title contains a text, in two columns: the first half of them is in the left one.
STUDY = """
    const kept = [...document.querySelectorAll('figure.panel')].filter((one) => one.querySelector('.panel-title').textContent.includes(arguments[0]));
    document.querySelectorAll('.menu').forEach((one) => one.remove());
    document.querySelector('main').replaceChildren(...kept);
    document.querySelector('main').style = `display: grid; grid: repeat(${Math.ceil(kept.length / 2)}, auto) / auto-flow minmax(0, 1fr); gap: 12px; padding: 12px; width: 970px`;
    for (const one of kept) one.style = 'margin: 0; width: auto';
    dispatchEvent(new Event('resize'));"""

# The live page, while the skin is pressed for two seconds and the contact moves.
PRESSED = """
    const done = arguments[0], wait = () => {
        if (!window.corpuscle || corpuscle.session.time === 0) return setTimeout(wait, 50);
        const {session, press} = corpuscle, x = press.x, y = press.y, from = session.time;
        const step = () => {
            const t = session.time - from;
            press.isDown = t > 0.5;
            press.moveTo(x + 2e-3 * Math.sin(3 * t), y + 1e-3 * t);
            if (t < 2.5) return requestAnimationFrame(step);
            session.isPaused = true;
            requestAnimationFrame(() => requestAnimationFrame(done));
        };
        step();
    };
    wait();"""


def start_browser(folder):
    options = Options()
    options.binary_location = "/usr/bin/chromium"
    for flag in [*FLAGS, f"--user-data-dir={folder}/profile"]:
        options.add_argument(flag)
    browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    browser.set_script_timeout(120)
    return browser


def draw_report(browser, folder, corpuscle, picture, *arguments):
    is_study = arguments[0] == "study"
    report = pathlib.Path(folder) / "report.html"
    command = ["study", arguments[1]] if is_study else ["respond", *arguments]
    subprocess.run([corpuscle, *command, "--report", report, "--quiet"], check=True)
    browser.get(report.as_uri())
    browser.execute_script(STUDY if is_study else RESPONSE, *arguments[2:3])
    browser.execute_async_script("setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(arguments[0])), 200)")
    return browser.find_element(By.TAG_NAME, "main").screenshot(picture)


def draw_live_page(browser, page, picture):
    browser.set_window_size(1300, 1000)
    browser.get(pathlib.Path(page).resolve().as_uri())
    browser.execute_async_script(PRESSED)
    return browser.save_screenshot(picture)


def main(first, picture, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        browser = start_browser(folder)
        try:
            is_drawn = draw_report(browser, folder, first, picture, *arguments) if arguments else draw_live_page(browser, first, picture)
        finally:
            browser.quit()
    if not is_drawn:
        sys.exit(f"{picture} cannot be written")


if __name__ == "__main__":
    main(*sys.argv[1:])
