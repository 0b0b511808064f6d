# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""Pages in headless Chromium, for the tests of reports and views.

The importing program ends with code 77 (skipped) where Chromium, its driver or Selenium (Debian:
chromium, chromium-driver, python3-selenium) is missing.
"""

import json
import pathlib
import shutil
import sys
import time

NAME = pathlib.Path(sys.argv[0]).name

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    print(f"{NAME}: skipped, no Selenium")
    sys.exit(77)

BROWSER = shutil.which("chromium")
DRIVER = shutil.which("chromedriver")
SIZES = [(1440, 1000), (1024, 768), (400, 800)]

if BROWSER is None or DRIVER is None:
    print(f"{NAME}: skipped, no Chromium or no driver")
    sys.exit(77)


def check(condition, text):
    if not condition:
        raise SystemExit(f"{NAME}: {text}")


class Page:
    """The page at an address, in a browser of its own."""

    def __init__(self, url, size, dark=False):
        options = webdriver.ChromeOptions()
        options.binary_location = BROWSER
        for argument in [
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            "--enable-unsafe-swiftshader",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            f"--window-size={size[0]},{size[1]}",
        ]:
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(DRIVER), options=options)
        if dark:
            self.driver.execute_cdp_cmd(
                "Emulation.setEmulatedMedia",
                {"features": [{"name": "prefers-color-scheme", "value": "dark"}]},
            )
        self.driver.get(url)
        self.wait("document.body.dataset.ready !== undefined")

    def __enter__(self):
        return self

    def __exit__(self, kind, value, trace):
        self.driver.quit()

    def run(self, script):
        return self.driver.execute_script(script)

    def wait(self, condition, seconds=30):
        end = time.monotonic() + seconds
        while not self.run(f"return Boolean({condition})"):
            check(time.monotonic() < end, f"never came true: {condition}")
            time.sleep(0.05)

    def find(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def check_quiet(self, url, *others):
        """No error in the console, and no request but for the page itself and these others."""
        for entry in self.driver.get_log("browser"):
            check(entry["level"] != "SEVERE", f"console: {entry['message']}")
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] != "Network.requestWillBeSent":
                continue
            asked = message["params"]["request"]["url"]
            own = asked in (url, *others) or asked.startswith(("data:", "blob:", url + "#"))
            check(own, f"request to {asked}")
