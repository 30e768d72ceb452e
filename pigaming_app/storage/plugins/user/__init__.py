"""Packages in the folder `games` of the user's data folder, imported as `pigaming_app.storage.plugins.user.NAME`."""

from pigaming_app.storage.settings import NoHome, folders

FOLDER = "games"  # below the data folder

try:
    __path__ = [str(folders().data / FOLDER)]
except NoHome:
    __path__ = []
