"""As much of the X protocol as it takes to press a window's close button where there is no window manager."""

import socket
import struct


def padded(data):
    return data + b"\0" * (-len(data) % 4)


class XClient:
    def __init__(self, display):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.socket.settimeout(60)
        self.socket.connect("/tmp/.X11-unix/X" + display.lstrip(":"))
        self.socket.sendall(struct.pack("<BxHHHHxx", ord("l"), 11, 0, 0, 0))
        accepted, _, _, _, length = struct.unpack("<BBHHH", self.receive(8))
        self.receive(4 * length)
        if accepted != 1:
            raise RuntimeError(f"the X server of {display} refused the connection")

    def receive(self, count):
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                raise RuntimeError("the X server closed the connection")
            data += part
        return data

    def atom(self, name):
        """InternAtom."""
        text = name.encode()
        self.socket.sendall(struct.pack("<BBHHxx", 16, 0, 2 + len(padded(text)) // 4, len(text)) + padded(text))
        return struct.unpack("<8xI20x", self.receive(32))[0]

    def close_window(self, window):
        """SendEvent with WM_DELETE_WINDOW: what a window manager sends when the close button is pressed."""
        protocols, delete = self.atom("WM_PROTOCOLS"), self.atom("WM_DELETE_WINDOW")
        event = struct.pack("<BBHIIIIIII", 33, 32, 0, window, protocols, delete, 0, 0, 0, 0)
        self.socket.sendall(struct.pack("<BBHII", 25, 0, 11, window, 0) + event)
        self.atom("WM_PROTOCOLS")  # its answer comes after the event was passed on

    def close(self):
        self.socket.close()
