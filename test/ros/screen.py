# SPDX-License-Identifier: BSD-3-Clause
"""A screen in memory, drawn by software."""
import os
import shutil
import signal
import subprocess

import numpy as np

import support

AVAILABLE = bool(shutil.which("Xvfb") and shutil.which("import"))


class Screen:
    """Runs an X server; `environment` is that of programs that draw on it."""

    def __init__(self, width=1280, height=800):
        self.width, self.height = width, height
        self._server = subprocess.Popen(
            ["Xvfb", "-displayfd", "1", "-screen", "0", "%dx%dx24" % (width, height), "-nolisten", "tcp"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        display = ":" + self._server.stdout.readline().decode().strip()
        self.environment = dict(os.environ, DISPLAY=display, LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1")

    def close(self):
        self._server.send_signal(signal.SIGINT)
        self._server.wait(support.PATIENCE)
        self._server.stdout.close()

    def picture(self):
        """height x width x 3, 0 to 255."""
        shot = subprocess.check_output(["import", "-silent", "-window", "root", "-depth", "8", "rgb:-"],
                                       env=self.environment)
        return np.frombuffer(shot, np.uint8).reshape(self.height, self.width, 3).astype(int)

    def like(self, color, tolerance=12):
        """Where the screen has about a colour (0 to 1): height x width, bool."""
        return np.abs(self.picture() - np.round(255 * np.array(color))).max(2) <= tolerance

    def keep(self, file):
        subprocess.check_call(["import", "-silent", "-window", "root", file], env=self.environment)
