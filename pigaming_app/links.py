"""Where PiGaming can be had. While a link is empty there is no such place, and no page and no message mentions one."""

DOWNLOAD = ""  # page with the bundles of all systems
CLONE = ""  # repository, as `git clone` takes it


def installing(extra: str) -> str:
    """How to add an extra to an installed package; no index has this one, so pip needs the project's folder."""
    return f"pip install '.[{extra}]' in the project's folder"
