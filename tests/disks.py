"""Simulated disk failures without privileges: a file size limit, and system calls that fail one by one."""

import contextlib
import errno
import os
from unittest import mock

STEPS = ("open", "fsync", "chmod", "replace", "rename", "mkdir")


@contextlib.contextmanager
def room_for(size):
    """Context in which no file can grow beyond this size in bytes, as on a full disk."""
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@contextlib.contextmanager
def failing_at(step):
    """Context in which the disk-changing system call number `step` (from 0) fails; yields the names of the calls."""
    made = []

    def failing(name, call):
        def one(*args, **options):
            if name == "open" and not args[1] & os.O_CREAT and os.path.isfile(args[0]):
                return call(*args, **options)  # a file is read
            made.append(name)
            if len(made) == step + 1:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return call(*args, **options)

        return one

    with contextlib.ExitStack() as patches:
        for name in STEPS:
            patches.enter_context(mock.patch.object(os, name, failing(name, getattr(os, name))))
        yield made


def content(folder):
    """The bytes of every file below a folder, by path."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
