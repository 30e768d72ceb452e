"""What a training tells while it runs: an event file that others read, and a picture."""

import csv
import struct
from pathlib import Path
from typing import Any

import pytest

from pigaming_app.jobs.cli import main
from pigaming_app.jobs.learning.train import ppo_training
from pigaming_app.jobs.learning.train.tensorboard import TensorboardFile, crc32c
from pigaming_app.storage.safe_files import NotSaved, write_atomic
from tests.ai.ppo.plain import SET, play_plain

RFC_3720 = {  # appendix B.4
    bytes(32): 0x8A9136AA,
    b"\xff" * 32: 0x62A8AB43,
    bytes(range(32)): 0x46DD794E,
    bytes(range(31, -1, -1)): 0x113FDB5C,
    bytes.fromhex(f"01c00000{3 * '00000000'}14000000000004000000001400000018280000000000000002000000{8 * '0'}"):
        0xD9963A56,
}  # fmt: skip


@pytest.mark.parametrize("content", RFC_3720)
def test_check_sums_are_those_of_the_standard(content):
    assert crc32c(content) == RFC_3720[content]


def event_class():
    """`Event` as tensorflow/core/util/event.proto and framework/summary.proto publish it, what is used here of them."""
    pytest.importorskip("google.protobuf")
    from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

    field = descriptor_pb2.FieldDescriptorProto
    messages = {
        "Summary.Value": [("tag", 1, field.TYPE_STRING, ""), ("simple_value", 2, field.TYPE_FLOAT, "")],
        "Summary": [("value", 1, field.TYPE_MESSAGE, ".tensorflow.Summary.Value")],
        "SessionLog": [("status", 1, field.TYPE_INT32, "")],
        "Event": [
            ("wall_time", 1, field.TYPE_DOUBLE, ""),
            ("step", 2, field.TYPE_INT64, ""),
            ("file_version", 3, field.TYPE_STRING, ""),
            ("summary", 5, field.TYPE_MESSAGE, ".tensorflow.Summary"),
            ("session_log", 7, field.TYPE_MESSAGE, ".tensorflow.SessionLog"),
        ],
    }
    file = descriptor_pb2.FileDescriptorProto(name="event.proto", package="tensorflow", syntax="proto3")
    made: dict[str, Any] = {}
    for name, entries in reversed(messages.items()):
        outer, _, inner = name.rpartition(".")
        message = made[name] = (made[outer].nested_type if outer else file.message_type).add(name=inner)
        for entry, number, kind, of in entries:
            label = field.LABEL_REPEATED if entry == "value" else field.LABEL_OPTIONAL
            message.field.add(name=entry, number=number, type=kind, label=label, type_name=of or None)
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName("tensorflow.Event"))


def events_in(folder):
    """The events of all files, the oldest first, framed as tensorflow/core/lib/io/record_reader.cc checks it."""
    kind, found = event_class(), []
    for path in sorted(Path(folder).iterdir()):
        assert path.name.startswith("events.out.tfevents.")
        raw = path.read_bytes()
        while raw:
            (length, check), content = struct.unpack("<QI", raw[:12]), raw[12:]
            assert check == masked(raw[:8])
            assert struct.unpack("<I", content[length : length + 4]) == (masked(content[:length]),)
            found.append(kind.FromString(content[:length]))
            raw = content[length + 4 :]
    return found


def masked(content):
    crc = crc32c(content)
    return (((crc >> 15) | (crc << 17) & 0xFFFFFFFF) + 0xA282EAD8) % 2**32


def test_an_event_has_its_step_and_its_finite_numbers(tmp_path):
    events = TensorboardFile(tmp_path / "runs", 0)
    events.add(300, {"learner/kl": 0.125, "learner/explained": float("nan"), "wins/hand3": -2.0})
    first, second = events_in(tmp_path / "runs")
    assert first.file_version == "brain.Event:2"
    assert second.step == 300
    assert abs(second.wall_time - first.wall_time) < 60.0
    assert [(value.tag, value.simple_value) for value in second.summary.value] == [
        ("learner/kl", 0.125),
        ("wins/hand3", -2.0),
    ]


def test_what_an_older_file_has_from_a_resumption_on_counts_no_longer(tmp_path):
    """A start of a session, by which TensorBoard drops it."""
    TensorboardFile(tmp_path, 200)
    _, start = events_in(tmp_path)
    assert (start.step, start.session_log.status) == (201, 1)


def test_a_folder_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "a").write_text("text")
    with pytest.raises(NotSaved, match=r"a was not made: "):
        TensorboardFile(tmp_path / "a", 0)


def test_a_training_tells_the_same_in_its_table_and_to_tensorboard(tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    play_plain(monkeypatch)
    monkeypatch.setattr(ppo_training, "SAVED_EVERY", 0.0)
    for measured in ("MEASURED", "MEASURED_AT_END", "MEASURED_EVERY"):
        monkeypatch.setattr(ppo_training, measured, 1)
    pages = []

    def noted(path, content):
        if path.suffix == ".png":
            pages.append(content)
        write_atomic(path, content)

    monkeypatch.setattr(ppo_training, "write_atomic", noted)
    job = ["train", "ppo", "pitanks", "--seed", "5", *SET, "--out", str(tmp_path / "a.npz"), "--updates", "2"]
    job += ["--csv", str(tmp_path / "a.csv"), "--tensorboard", str(tmp_path / "runs")]
    assert main([*job, "--curve", str(tmp_path / "a.png")]) == 0
    assert len(pages) == 3, "after each update, and at the end"
    assert pages[0] != pages[1]
    assert all(page.startswith(b"\x89PNG") for page in pages)
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    _, *updates = events_in(tmp_path / "runs")
    assert [event.step for event in updates] == [1, 2]
    for event, row in zip(updates, rows[1:], strict=True):
        told = {value.tag: value.simple_value for value in event.summary.value}
        for figure in ("mean_return", "kl", "clipped", "entropy", "value_loss", "explained"):
            assert told[f"learner/{figure}"] == pytest.approx(float(row[figure]), rel=1e-4, abs=1e-9)
            assert told[f"exploiter/{figure}"] == pytest.approx(float(row[f"exploiter_{figure}"]), rel=1e-4, abs=1e-9)
        assert told["training/decisions"] == int(row["decisions"])
        assert told["training/pool"] == int(row["pool"])
        assert 0.0 <= told["wins/idle"] <= 1.0
