#!/usr/bin/python3
"""live_page.py PAGE: how soon the live page (make page) responds after it is opened from disk, and how smoothly it runs, in Debian's headless
Chromium, which draws in software. The page simulates a fingertip of 998 afferents, sa1, sa1-nerve and the chip sa1-circuit at 2 kHz.

Prints the size of the page, and the time from its opening to the first simulated answer (median of 5). Then, at rest and pressed with 1 N by a contact
that moves, it prints frames per second, the 95th percentile of the time between frames, and simulated seconds per second."""
import pathlib
import shutil
import statistics
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

FLAGS = ("--headless=new --no-sandbox --disable-gpu --no-first-run --disable-background-networking --disable-component-update --disable-sync "
         "--window-size=1400,900").split()
LINK = "#rows=sa1,sa1-nerve,sa1-circuit&rate=2000&skin=fingertip"
SECONDS = 5

# The times of the frames of the screen, ms, and the simulated time at both ends, s.
MEASURE = """
    const [seconds, isPressed, done] = arguments, {session, press, skinView} = corpuscle, frames = [], begin = performance.now(), from = session.time;
    const x = press.x, y = press.y;
    press.isDown = isPressed;
    const frame = (now) => {
        frames.push(now);
        if (isPressed) press.moveTo(x + 3e-3 * Math.sin(now / 300), y);
        if (now - begin < 1000 * seconds) requestAnimationFrame(frame);
        else { press.isDown = false; press.moveTo(x, y); done([frames, (session.time - from) / (now - begin) * 1000]); }
    };
    requestAnimationFrame(frame);"""


def open_page(browser, page):
    """Opens the page. Returns the time until the first simulated answer is shown, s."""
    browser.get("about:blank")
    begin = time.perf_counter()
    browser.get(page.as_uri() + LINK)
    browser.execute_async_script("const done = arguments[0], wait = () => window.corpuscle && corpuscle.session.time > 0 ? done() : setTimeout(wait, 5); wait();")
    return time.perf_counter() - begin


def main():
    page = pathlib.Path(sys.argv[1]).resolve()
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        for flag in [*FLAGS, "--user-data-dir=" + profile]:
            options.add_argument(flag)
        browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        try:
            browser.set_script_timeout(60)
            starts = [open_page(browser, page) for _ in range(5)]
            print(f"page {page.stat().st_size / 1e6:.2f} MB; first answer after {statistics.median(starts):.2f} s ({min(starts):.2f} to {max(starts):.2f})")
            for name, is_pressed in (("at rest", False), ("pressed", True)):
                browser.execute_async_script(MEASURE, 1, is_pressed)  # warm
                frames, speed = browser.execute_async_script(MEASURE, SECONDS, is_pressed)
                steps = sorted(b - a for a, b in zip(frames, frames[1:]))
                capacity = browser.execute_script("return corpuscle.session.speed")
                print(f"{name}: {1000 * len(steps) / sum(steps):.1f} frames/s, 95 % of them within {steps[len(steps) * 95 // 100]:.1f} ms; "
                      f"{speed:.2f} s simulated per second, the engine alone could {capacity:.2f}")
        finally:
            browser.quit()


main()
