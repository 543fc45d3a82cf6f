"""As much of the X protocol as a mouse, a close button, a file manager and a monitor's settings take."""

import socket
import struct

SELECTION_REQUEST = 30
RESOURCE_MANAGER, STRING = 23, 31  # atoms that every server has


def padded(data):
    return data + b"\0" * (-len(data) % 4)


class XClient:
    def __init__(self, display):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.socket.settimeout(60)
        self.socket.connect("/tmp/.X11-unix/X" + display.lstrip(":"))
        self.socket.sendall(struct.pack("<BxHHHHxx", ord("l"), 11, 0, 0, 0))
        accepted, _, _, _, length = struct.unpack("<BBHHH", self.receive(8))
        setup = self.receive(4 * length)
        if accepted != 1:
            raise RuntimeError(f"the X server of {display} refused the connection")
        self.id, vendor, formats = struct.unpack("<4xI8xH3xB", setup[:22])
        self.xtest = None
        self.root, = struct.unpack_from("<I", setup, 32 + len(padded(b" " * vendor)) + 8 * formats)

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
        return struct.unpack("<8xI20x", self.answer(1))[0]

    def extension(self, name):
        """QueryExtension: the opcode of its requests."""
        text = name.encode()
        self.socket.sendall(struct.pack("<BxHHxx", 98, 2 + len(padded(text)) // 4, len(text)) + padded(text))
        present, opcode = struct.unpack("<8xBB22x", self.answer(1))
        if not present:
            raise RuntimeError(f"the X server has no {name}")
        return opcode

    def move_mouse(self, x, y):
        """The mouse itself goes there (FakeInput of XTEST). After XWarpPointer, which xdotool uses, a window on
        a loaded machine was twice never told, though the cursor stood there."""
        if self.xtest is None:
            self.xtest = self.extension("XTEST")
        motion, absolute = 6, 0
        self.socket.sendall(struct.pack("<BBHBBxxII8xhh8x", self.xtest, 2, 9, motion, absolute, 0, self.root, x, y))

    def mouse(self):
        """QueryPointer: where the server has it."""
        self.socket.sendall(struct.pack("<BxHI", 38, 2, self.root))
        return struct.unpack("<16xhh12x", self.answer(1))

    def answer(self, code):
        """The next reply (1) or event of that code; others are passed over."""
        while True:
            packet = self.receive(32)
            if packet[0] == 0:
                raise RuntimeError(f"the X server says error {packet[1]}")
            if packet[0] & 127 == code:
                return packet

    def send_event(self, window, event):
        self.socket.sendall(struct.pack("<BBHII", 25, 0, 11, window, 0) + event.ljust(32, b"\0"))

    def send_message(self, window, kind, *values):
        """A ClientMessage of up to five numbers."""
        values += (0,) * (5 - len(values))
        self.send_event(window, struct.pack("<BBHII5I", 33, 32, 0, window, kind, *values))

    def set_property(self, window, name, kind, data):
        """ChangeProperty."""
        head = struct.pack("<BBHIIIBxxxI", 18, 0, 6 + len(padded(data)) // 4, window, name, kind, 8, len(data))
        self.socket.sendall(head + padded(data))

    def close_window(self, window):
        """What a window manager sends when the close button is pressed."""
        self.send_message(window, self.atom("WM_PROTOCOLS"), self.atom("WM_DELETE_WINDOW"))
        self.atom("WM_PROTOCOLS")  # its answer comes after the event was passed on

    def set_dpi(self, dpi):
        """What the desktop's settings say of its monitor, for programs that start from now on."""
        self.set_property(self.root, RESOURCE_MANAGER, STRING, f"Xft.dpi:\t{dpi}\n".encode())
        self.atom("WM_PROTOCOLS")

    def drop(self, window, file, x, y):
        """What a file manager sends when a file is dropped on a window (XDND version 5)."""
        selection, uris = self.atom("XdndSelection"), self.atom("text/uri-list")
        own = self.id
        self.socket.sendall(struct.pack("<BBHIIhhHHHHII", 1, 0, 8, own, self.root, 0, 0, 1, 1, 0, 1, 0, 0))  # a window
        self.socket.sendall(struct.pack("<BBHIII", 22, 0, 4, own, selection, 0))  # SetSelectionOwner
        self.send_message(window, self.atom("XdndEnter"), own, 5 << 24, uris)
        self.send_message(window, self.atom("XdndPosition"), own, 0, x << 16 | y, 0, self.atom("XdndActionCopy"))
        self.send_message(window, self.atom("XdndDrop"), own, 0, 0)
        time, _, requestor, _, target, name = struct.unpack("<4x6I4x", self.answer(SELECTION_REQUEST))
        self.set_property(requestor, name, target, f"file://{file}\r\n".encode())
        self.send_event(requestor, struct.pack("<BBHIIIII", 31, 0, 0, time, requestor, selection, target, name))
        self.atom("WM_PROTOCOLS")

    def close(self):
        self.socket.close()
