"""Changed controls: the key or button of each function, by key cluster and by kind of pad.

Settings hold what differs from the defaults, {"keys1": {"fire": 9}, "Xbox": {"turbo": 2}}: scancodes of keys, numbers
of buttons. Each key or button has one function: a function that gets one that is taken gives its own in return.
"""

from collections.abc import Mapping

Codes = dict[str, int]  # by function
Tables = dict[str, Codes]  # by device


def merged(
    defaults: Mapping[str, Mapping[str, int]], changed: Mapping[str, Mapping[str, int]], shared: bool = True
) -> Tables:
    """The codes of all devices. Changes that contradict each other do not count.

    `shared`: the devices are parts of one keyboard, on which each key has one function.
    """
    if not shared:
        return {device: merged({device: codes}, changed)[device] for device, codes in defaults.items()}
    tables = {device: dict(codes) for device, codes in defaults.items()}
    for device, codes in tables.items():
        codes.update({name: code for name, code in changed.get(device, {}).items() if name in codes})
    used = [code for codes in tables.values() for code in codes.values()]
    return tables if len(set(used)) == len(used) else {device: dict(codes) for device, codes in defaults.items()}


def assigned(tables: Tables, device: str, function: str, code: int) -> Tables:
    """The tables after `function` of `device` got `code`; whatever had it gets the code that has become free."""
    free = tables[device][function]
    after = {
        name: {other: free if taken == code else taken for other, taken in codes.items()}
        for name, codes in tables.items()
    }
    after[device][function] = code
    return after


def differences(tables: Tables, defaults: Mapping[str, Mapping[str, int]]) -> Tables:
    """The codes that are not the defaults."""
    own = {
        device: {name: code for name, code in codes.items() if code != defaults[device][name]}
        for device, codes in tables.items()
    }
    return {device: codes for device, codes in own.items() if codes}
