"""The sheet of markers, written for a printer."""

import logging

from pigaming_app.hardware.session.guide import SHEET
from pigaming_app.hardware.vision.markers import OpenCVMissing
from pigaming_app.scenes.pages.page import Page
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.settings import folders
from pigaming_app.ui.i18n import english, with_english

log = logging.getLogger("pigaming")


def write_sheet(page: Page) -> str:
    """Save the marker sheet to the user's folder. Returns where it is, or why it is not, in the page's language."""
    from pigaming_app.scenes.mat.paper.marker_sheet import sheet

    path, words = folders().data / SHEET, page.context.words
    notes = with_english(words.language, "sheet.print", "sheet.cut")
    try:
        drawn = sheet(notes=notes, block_notes=with_english(words.language, "sheet.blocks"))
    except OpenCVMissing as missing:
        log.warning("%s", english().long_sentence(missing.message))
        return words.sentence(missing.message)
    return words("robots.written", path=path) if page.save(lambda: write_atomic(path, drawn)) else page.message
