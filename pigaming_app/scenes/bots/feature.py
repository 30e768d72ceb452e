"""Programs of pupils as a feature: the server, the stream of the match on the screen, and their page in the options."""

from pigaming_app.ai.bots import brains
from pigaming_app.ai.bots.line import Serving
from pigaming_app.scenes.bots.host import bot_host
from pigaming_app.scenes.bots.page import sketch
from pigaming_app.scenes.features.feature import Feature, OptionRow, Service
from pigaming_app.scenes.flow.scene import Context, Scene, Stack
from pigaming_app.scenes.launch import Options


class BotService(Service):
    """Follows the settings and sends the match that is on the screen."""

    def __init__(self, context: Context) -> None:
        self.context, self.host = context, context.shared(bot_host)
        brains.serve(Serving.LIVE)

    def update(self, seconds: float, stack: Stack) -> None:
        settings = self.context.settings
        self.host.follow(settings.bots, settings.bots_vision, settings.phones_network)
        self.host.show(stack.scenes)

    def close(self) -> None:
        self.host.close()


def service(context: Context, options: Options) -> Service:
    return BotService(context)


def page(context: Context) -> Scene:
    from pigaming_app.scenes.bots.page import BotsPage

    return BotsPage(context)


FEATURE = Feature(
    "bots",
    rooms=("scenes.bots", "ai.bots", "jobs.bots", "ui.web.sockets"),
    options={"bots": OptionRow("controls", "phones", page, sketch)},
    service=service,
)
