"""The server for phones of a context."""

from pigaming_app.scenes.flow.scene import Context
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.phones.host import PhoneHost


def phone_host(context: Context) -> PhoneHost:
    """Made at first use: `context.shared(phone_host)`."""
    return PhoneHost(context.controls.phones, data=lambda: folders().data)
