# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""A file by a writer that does not tell when the disk is full: it writes into a named pipe."""
from __future__ import annotations

import errno
import os
import pathlib
import tempfile
import threading
from typing import Optional

_BLOCK = 1 << 20  # bytes


class PipedFile:
    """Has its name once it is whole; raises OSError where it cannot be written."""

    def __init__(self, file: pathlib.Path) -> None:
        if file.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        self._file = file
        self._partial = file.with_name(f".{file.name}.{os.getpid()}")
        self._output = self._partial.open("wb")
        self._failure: Optional[OSError] = None
        self._folder = tempfile.TemporaryDirectory(prefix="vinebench-")
        self.pipe = f"{self._folder.name}/pipe"
        """To be opened, written and closed once."""
        os.mkfifo(self.pipe)
        self._copier = threading.Thread(target=self._copy, daemon=True)
        self._copier.start()

    def _copy(self) -> None:
        with open(self.pipe, "rb") as pipe:
            while block := pipe.read(_BLOCK):
                if self._failure is None:  # else to its end, for the writer would wait
                    try:
                        self._output.write(block)
                    except OSError as error:
                        self._failure = error

    def _close(self) -> None:
        """After the writer has closed the pipe."""
        self._copier.join()
        self._folder.cleanup()
        try:
            self._output.close()
        except OSError as error:
            self._failure = self._failure or error

    def finish(self) -> None:
        """Gives the file its name."""
        self._close()
        if self._failure is not None:
            self._partial.unlink(missing_ok=True)
            raise self._failure
        os.replace(self._partial, self._file)

    def discard(self) -> None:
        """Leaves no file."""
        self._close()
        self._partial.unlink(missing_ok=True)
