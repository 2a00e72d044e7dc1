# SPDX-License-Identifier: BSD-3-Clause
"""A server of ParaView for a test."""
import contextlib
import socket
import subprocess


@contextlib.contextmanager
def server(program):
    """A pvserver, by its program, that serves one client; its port."""
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = free.getsockname()[1]
    with subprocess.Popen([program, f"--server-port={port}"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        try:
            for line in process.stdout:
                if "Accepting connection" in line:
                    break
            yield port
        finally:
            process.terminate()
            process.communicate()
