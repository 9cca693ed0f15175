"""Commands that are held where a test wants them, so that no test depends on the clock.

A command that writes to a pipe which is full waits in write(2) until it is read from. Held(call, "stderr") starts one whose
standard error is such a pipe: with -v it stops at the first line that -v prints, which is when it has read its graph and
begins its work.
"""

import fcntl
import os
import signal
import subprocess
import time

F_SETPIPE_SZ = 1031


def full_pipe(room):
    """Its two ends, and how many bytes of filling come before what is written later; it has room for so many bytes."""
    reader, writer = os.pipe()
    fcntl.fcntl(writer, F_SETPIPE_SZ, 4096)
    return reader, writer, os.write(writer, b"." * (4096 - room))


class Held:
    def __init__(self, call, stream, room=0):
        self.reader, writer, self.filling = full_pipe(room)
        self.other_name = "stdout" if stream == "stderr" else "stderr"
        streams = {stream: writer, self.other_name: subprocess.PIPE}
        self.process = subprocess.Popen(call, stdin=subprocess.DEVNULL, **streams)
        os.close(writer)
        self.wait_in_write({"stdout": 1, "stderr": 2}[stream])

    def proc(self, name):
        with open(f"/proc/{self.process.pid}/{name}", encoding="ascii") as file:
            return file.read()

    def wait_in_write(self, descriptor):
        """write(2) is system call 1 or, on other machines, 64."""
        while True:
            words = self.proc("syscall").split()
            if words[0] in ("1", "64") and int(words[1], 16) == descriptor:
                return
            if self.process.poll() is not None:
                raise AssertionError(f"{self.process.args} has ended: {self.process.returncode}")
            time.sleep(0.002)

    def interrupt(self, number=signal.SIGINT):
        """Sends the signal and waits until the process has seen it."""
        self.process.send_signal(number)
        bit = 1 << (number - 1)
        while self.process.poll() is None:
            pending = [line.split()[1] for line in self.proc("status").splitlines() if line[:6] in ("SigPnd", "ShdPnd")]
            if not any(int(mask, 16) & bit for mask in pending):
                return
            time.sleep(0.002)

    def release(self):
        """Lets it go on; its status, what it wrote to the stream that was held, and to the other."""
        text = b""
        other = getattr(self.process, self.other_name)
        while chunk := os.read(self.reader, 4096):
            text += chunk
        os.close(self.reader)
        rest = other.read()
        self.process.wait()
        other.close()
        return self.process.returncode, text[self.filling:].decode(), rest.decode()
