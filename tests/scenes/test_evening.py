"""A whole evening: from the title through lobby and match to the results, a rematch, and back."""

import pytest

from pigaming_app.scenes.flow.scene import Stack
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.initials import Initials
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.title.scene import Title
from tests.scenes.arcade import Arcade
from tests.ui.input.virtual_pad import VirtualPad


@pytest.mark.long
def test_two_friends_and_a_loose_cable(arcade: Arcade) -> None:
    arcade.context.settings.choice("pitanks").minutes = 1
    arcade.stack = Stack(Title(arcade.context))

    def tap(pad: VirtualPad, *buttons: str) -> None:
        for button in buttons:
            pad.tap(button)
            arcade.wait(0.2, draw=True)

    (one, first), (two, second) = arcade.plug(), arcade.plug()
    arcade.wait(0.5, draw=True)
    tap(one, "a")
    arcade.shown(Lobby)
    tap(two, "a")
    tap(one, "a")
    tap(two, "a")
    match = arcade.reach(MatchScene, 10.0)
    assert match.devices[:2] == [first, second]
    arcade.wait(8.0)
    two.unplug()
    arcade.wait(1.5, draw=True)
    arcade.shown(Reconnect)
    again, third = arcade.plug()
    arcade.wait(0.5, draw=True)
    tap(again, "a")
    assert arcade.shown(MatchScene) is match
    one.stick(0.2, -1.0)
    one.press("a")
    arcade.until(lambda: match.match.over, 80.0)
    one.release("a")
    one.stick(0.0, 0.0)
    arcade.until(lambda: isinstance(arcade.stack.top, Results))
    arcade.wait(6.0, draw=True)
    if isinstance(arcade.stack.top, Initials):
        tap(one, "start", "start")
        arcade.until(lambda: isinstance(arcade.stack.top, Results), 60.0)
    tap(one, "a")
    tap(again, "a")
    rematch = arcade.shown(MatchScene)
    assert rematch is not match
    assert rematch.devices == [first, third, None, None]
