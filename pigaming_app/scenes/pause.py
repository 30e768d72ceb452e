"""The page over a match that stands still: who paused, and what now."""

from collections.abc import Sequence
from typing import Protocol

import pygame

from pigaming_app.scenes.house import House
from pigaming_app.scenes.press import Device
