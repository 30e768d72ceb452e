"""All features: those with screens, and those of jobs and modules alone, declared in `jobs/NAME/feature.py`."""

from pkgutil import iter_modules

from pigaming_app import jobs as room
from pigaming_app.scenes.features.feature import Feature
from pigaming_app.scenes.features.registry import declared, features


def every_feature() -> tuple[Feature, ...]:
    """All features that are there."""
    packages = [module.name for module in iter_modules(room.__path__) if module.ispkg]
    return (*features(), *(feature for name in packages if (feature := declared(f"jobs.{name}"))))
