"""The public page as files: complete, in every language, from a disk and in a real browser."""

import re
from datetime import datetime
from pathlib import Path

import pytest

from pigaming_app.jobs.cli import main
from pigaming_app.scenes.events.desk.site import site
from pigaming_app.ui.i18n import LANGUAGES
from tests.scenes.events.desk.examples import cup, new_event
from tests.scenes.events.desk.test_browser import NAMES, PROJECTOR, browser, story
from tests.scenes.phones.browser import Browser, chromium
from tests.ui.web.test_markup import HOSTILE, Reader

AT = datetime(2026, 11, 29, 10, 0)
_ = browser  # a fixture


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_link_and_file_is_in_the_folder(tmp_path: Path, language: str) -> None:
    names = [name[:24] for name in HOSTILE if name.isprintable()]
    files = site(cup(new_event(tmp_path, *names)), language, AT)
    assert files["index.html"] == files[f"{language}.html"]
    used = set()
    for name in [name for name in files if name.endswith(".html")]:
        read = Reader(files[name].decode())
        links = [words.get("href") or words.get("src") for _, words in read.elements]
        used |= {link for link in links if link and link != "data:,"}
        assert all(one in read.text for one in names)
        assert not [element for element, _ in read.elements if element in ("form", "input", "iframe", "img")]
    used |= {*re.findall(r"url\((.*?)\)", files["desk.css"].decode())}
    assert used <= {*files}
    assert {*files} - used == {"index.html"}
    assert b"http" not in files["desk.css"]
    assert b"://" not in files["desk.js"]


def test_the_job_writes_it_again_and_leaves_other_files(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    path = new_event(tmp_path)
    assert main(["event", "export", str(path), "--site", "site"]) == 0
    (tmp_path / "site" / "other.txt").write_text("x")
    assert main(["event", "result", str(path), "1", "Ana=7", "Caio=2", "--json"]) == 0
    assert main(["event", "export", str(path), "--site", "site", "--csv", "table.csv"]) == 0
    assert "1. Ana 7" in (tmp_path / "site" / "index.html").read_text(encoding="utf-8")
    assert (tmp_path / "site" / "other.txt").exists()
    capsys.readouterr()
    for folder in ("cup.json", "nowhere/site"):
        assert main(["event", "export", str(path), "--site", folder]) == 2
        assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "nowhere").exists()


@pytest.mark.long
@pytest.mark.skipif(not chromium(), reason="no Chromium: apt-get install chromium")
def test_it_works_from_a_disk(tmp_path: Path, browser: str) -> None:
    path = new_event(tmp_path, *NAMES)
    (tmp_path / "site").mkdir()
    for name, content in site(cup(path), "en", AT).items():
        (tmp_path / "site" / name).write_bytes(content)

    async def tell(browser: Browser) -> None:
        url = (tmp_path / "site" / "index.html").as_uri()
        page = await browser.phone(url, (390, 844))
        await page.until("document.body.innerText.includes('<b>Hanna</b>')")
        assert await page.value("getComputedStyle(document.body.parentElement).backgroundColor") == "rgb(0, 0, 0)"
        await page.until("[...document.fonts].filter((font) => font.status === 'loaded').length === 2")
        await page.value("window.before = 1; document.querySelector('[lang=de]').click(); 1")
        await page.until("!window.before && document.documentElement.lang === 'de'")
        big = await browser.phone(f"{url}?big", PROJECTOR)
        await big.until("document.querySelectorAll('.shown').length === 1")

    story(browser, tell)
