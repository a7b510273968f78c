# SPDX-License-Identifier: Apache-2.0
"""Looks at the site in Chromium: light and dark, 400 and 1400 pixels wide. Fails where a page is wider than its window or
a picture is missing; with --keep DIR leaves screenshots.

    look.py SITE [--keep DIR] [PAGE ...]
"""
from __future__ import annotations

import argparse
import html
import pathlib
import re
import subprocess
import sys
import tempfile

PAGES = ["index", "README", "stencils/docs/tour", "stencils/docs/tested", "stencils/docs/verbs/sample", "schemes/index",
         "schemes/loop", "eval/table_format", "api/lib-limit", "stencils/docs/python_reference"]
MEASURE = """<script>
addEventListener('load', () => {
  const page = document.documentElement, wrong = [];
  if (page.scrollWidth > innerWidth) wrong.push('the page is ' + page.scrollWidth + ' wide in ' + innerWidth);
  for (const picture of document.images)
    if (!picture.complete || picture.naturalWidth === 0) wrong.push('no picture ' + picture.getAttribute('src'));
  document.title = 'measured: ' + (wrong.join('; ') || 'sound');
});
</script>"""


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("site", type=pathlib.Path)
    parser.add_argument("pages", nargs="*", default=PAGES)
    parser.add_argument("--keep", type=pathlib.Path)
    told = parser.parse_args()
    site, wrong = told.site.resolve(), []
    with tempfile.TemporaryDirectory() as profile:
        browser = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--allow-file-access-from-files",
                   f"--user-data-dir={profile}", "--virtual-time-budget=4000"]
        for page in told.pages:
            source = site / f"{page}.html"
            text = source.read_text()
            for theme in ("light", "dark"):
                # Furo follows the reader's system; here it is told.
                shown = re.sub(r'<body[^>]*>', f'<body data-theme="{theme}">', text.replace("</head>", MEASURE + "</head>"))
                shown = shown.replace('document.body.dataset.theme = localStorage.getItem("theme") || "auto";', "")
                copy = source.with_name(f".look-{source.name}")
                copy.write_text(shown)
                try:
                    for width in (400, 1400):
                        # A window cannot be as narrow as a phone: a frame can.
                        frame = site / ".look-frame.html"
                        frame.write_text(f'<body style="margin:0"><iframe src="{html.escape(str(copy.relative_to(site)))}" '
                                         f'style="border:0;width:{width}px;height:2000px" onload="setTimeout(() => '
                                         "document.title = document.querySelector('iframe').contentDocument.title, 500)\">"
                                         "</iframe></body>")
                        command = [*browser, f"--window-size={max(width, 500)},2000"]
                        dom = subprocess.run([*command, "--dump-dom", frame.as_uri()], capture_output=True, text=True,
                                             timeout=120, check=False).stdout
                        found = re.search(r"<title>measured: (.*?)</title>", dom)
                        if not found or found.group(1) != "sound":
                            wrong.append(f"{page}, {theme}, {width}: {found.group(1) if found else 'not measured'}")
                        if told.keep:
                            told.keep.mkdir(parents=True, exist_ok=True)
                            picture = told.keep.resolve() / f"{page.replace('/', '-')}-{theme}-{width}.png"
                            subprocess.run([*command, f"--screenshot={picture}", frame.as_uri()], capture_output=True,
                                           timeout=120, check=False)
                        frame.unlink()
                finally:
                    copy.unlink()
    print("\n".join(wrong) or f"{len(told.pages)} pages are sound, light and dark, 400 and 1400 wide")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
