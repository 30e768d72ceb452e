"""Pages of a PDF as pictures, by PDFium, which is the renderer of a browser, and the markers on them, by OpenCV."""

import cv2
import numpy as np
import pypdfium2

POINTS = 72.0 / 25.4  # of a mm


def pictures(pdf: bytes, per_mm: float, pages=None):
    """Grey pictures of pages, (height, width), with so many px per mm, if that makes whole px of a page.

    PDFium rounds up to whole px and stretches the page to them: hence the millionth.
    """
    file = pypdfium2.PdfDocument(pdf)
    for number in range(len(file)) if pages is None else pages:
        bitmap = file[number].render(scale=per_mm / POINTS * (1.0 - 1e-6), grayscale=True)
        yield np.asarray(bitmap.to_numpy()).squeeze()


def found(picture, per_mm: float):
    """Corners of the markers in a picture by number, mm, (4, 2)."""
    options = cv2.aruco.DetectorParameters()
    options.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    corners, numbers, _ = cv2.aruco.ArucoDetector(dictionary, options).detectMarkers(picture)
    seen = zip(np.asarray(numbers).reshape(-1).tolist(), np.asarray(corners).reshape(-1, 4, 2), strict=True)
    return {number: (mark + 0.5) / per_mm for number, mark in seen}


def texts(pdf: bytes):
    """The text of each page."""
    return [page.get_textpage().get_text_bounded() for page in pypdfium2.PdfDocument(pdf)]


def sizes(pdf: bytes):
    """Width and height of each page, mm."""
    return [tuple(side / POINTS for side in page.get_size()) for page in pypdfium2.PdfDocument(pdf)]
