# SPDX-License-Identifier: LGPL-2.1-or-later
"""A process that runs commands of the program which it is asked for, as its libraries are loaded once."""

import socket
import struct
import subprocess
import sys


class CommandServer:
    def __init__(self, *command):
        self.ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.process = subprocess.Popen(command, stdin=theirs)
        theirs.close()

    def ask(self, *texts):
        """The number that it answers to a packet of texts."""
        self.ours.send(b"".join(str(text).encode() + b"\0" for text in texts))
        answer = self.ours.recv(4)
        if len(answer) != 4:
            sys.exit("the process that runs the commands has ended")
        return struct.unpack("i", answer)[0]

    def close(self):
        self.ours.close()
        self.process.wait()
