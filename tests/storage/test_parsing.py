"""Parsing of arbitrary files terminates quickly, with a value that can be validated or an error of one short line."""

import errno
import os
from math import inf

import pytest

from pigaming_app.storage.parsing import (
    MAX_DEPTH,
    MESSAGE_LENGTH,
    ParseError,
    describe_error,
    one_line,
    parse_json,
    parse_toml,
    quote,
    read,
    read_text,
)

DEEP_TOML = {
    "lists": "a = " + "[" * 2000 + "]" * 2000,
    "inline tables": "a = " + "{a = " * 2000 + "1" + "}" * 2000,
    "a dotted key": ".".join("a" * 2000) + " = 1",
    "a long dotted key": ".".join("a" * 400_000) + " = 1",
    "a dotted header": "[" + " . ".join("a" * 2000) + "]",
    "just too deep": "a = " + "[" * (MAX_DEPTH + 1) + "]" * (MAX_DEPTH + 1),
}
DEEP_JSON = {"lists": "[" * 2000 + "]" * 2000, "tables": '{"a":' * 100_000 + "1" + "}" * 100_000}


@pytest.mark.parametrize("text", DEEP_TOML.values(), ids=DEEP_TOML)
def test_deep_toml_is_refused(text):
    with pytest.raises(ParseError, match="nested more than"):
        parse_toml(text)


@pytest.mark.parametrize("text", DEEP_JSON.values(), ids=DEEP_JSON)
def test_deep_json_is_refused(text):
    with pytest.raises(ParseError, match="nested more than"):
        parse_json(text)


@pytest.mark.parametrize("digits", [20, 400, 4000])
def test_a_number_beyond_64_bits_is_infinite(digits):
    number = "9" * digits
    assert parse_toml(f"a = {number}\nb = [-{number}]") == {"a": inf, "b": [-inf]}
    assert parse_json(f'{{"a": {number}, "b": [-{number}]}}') == {"a": inf, "b": [-inf]}
    assert parse_json(number) == inf


def test_the_limits_of_64_bits_stay_whole():
    assert parse_toml(f"a = {2**63 - 1}\nb = {-(2**63)}") == {"a": 2**63 - 1, "b": -(2**63)}


def test_5000_digits_give_a_value_or_an_error_of_one_line():
    assert parse_json("[" + "9" * 5000 + "]") == [inf]
    with pytest.raises(ParseError, match="too many digits"):
        parse_toml("a = " + "9" * 5000)


@pytest.mark.parametrize("text", ["a =", "a = 1979-13-01", "a = 0000-01-01", '"\x00" = 1', "a = \n" * 3000, "\ufeff"])
def test_broken_toml_is_one_short_line(text):
    with pytest.raises(ParseError) as refused:
        parse_toml(text)
    assert len(str(refused.value)) <= MESSAGE_LENGTH + 1
    assert str(refused.value).isprintable()


@pytest.mark.parametrize("text", ["", "{", "\x00", b"\xff\xfe\x00", b"\xed\xa0\x80", '"\n"'])
def test_broken_json_is_one_short_line(text):
    with pytest.raises(ParseError) as refused:
        parse_json(text)
    assert str(refused.value).isprintable()


def test_a_file_is_read_up_to_the_limit(tmp_path):
    (tmp_path / "file").write_bytes(b"\xef\xbb\xbfabc\r\n")
    assert read_text(tmp_path / "file", 8) == "abc\r\n"
    with pytest.raises(OSError, match="larger than 7 bytes"):
        read(tmp_path / "file", 7)


def test_bytes_that_are_not_utf_8_are_refused(tmp_path):
    (tmp_path / "file").write_bytes(b"\xff\xfe")
    with pytest.raises(ParseError, match="not text in UTF-8"):
        read_text(tmp_path / "file")


@pytest.mark.skipif(os.name != "posix", reason="devices and pipes are files on POSIX only")
def test_devices_and_pipes_are_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", tmp_path, *map(type(tmp_path), ("/dev/zero", "/dev/full"))):
        with pytest.raises(OSError, match="not a file"):
            read(path)


def test_a_message_is_one_line_whatever_it_quotes():
    assert one_line("a\nb\x1b[2J\u2028\udcff") == r"a\nb\x1b[2J\u2028\udcff"
    assert len(one_line("x" * 100_000)) <= MESSAGE_LENGTH + 1
    assert quote("a" * 300).startswith("'aaaa")
    assert quote("a" * 300).endswith("aaaa'")
    assert quote([10**30] * 50).isprintable()


@pytest.mark.parametrize(
    ("number", "reason"),
    [(errno.ENOSPC, "the disk is full"), (errno.EROFS, "no permission"), (errno.EIO, os.strerror(errno.EIO))],
)
def test_an_error_of_the_system_is_a_phrase(number, reason):
    assert describe_error(OSError(number, os.strerror(number))) == reason
