"""Calls of commands by processes that have loaded them already (prefork.cpp), where PREFORK_LIBRARY says where that is.

Without it, under the sanitizers for one, a call is started as any."""
import os
import signal
import socket
import struct
import subprocess
import threading

TIMEOUT = 60  # seconds of a call
LIBRARY = os.environ.get("PREFORK_LIBRARY", "")
own = threading.local()  # what a thread has loaded


class Done:
    def __init__(self, status, stdout, stderr):
        self.returncode, self.stdout, self.stderr = status, stdout, stderr


class Loaded:
    def __init__(self, path, folder):
        self.key = path, folder
        self.socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        environment = dict(os.environ, LD_PRELOAD=LIBRARY, PREFORK=str(theirs.fileno()))
        self.process = subprocess.Popen([path], cwd=folder, env=environment, pass_fds=[theirs.fileno()], stdin=subprocess.DEVNULL)
        theirs.close()

    def number(self):
        answer = self.socket.recv(4)
        if len(answer) != 4: raise EOFError
        return struct.unpack("i", answer)[0]

    def call(self, words, streams, flags):
        text = bytes([flags]) + b"".join(os.fsencode(word) + b"\0" for word in words)
        socket.send_fds(self.socket, [text], streams)
        try:
            process = self.number()
            self.socket.settimeout(TIMEOUT)
            return self.number()
        except TimeoutError:
            os.kill(process, signal.SIGKILL)
            del own.loaded[self.key]
            raise subprocess.TimeoutExpired(words, TIMEOUT) from None
        except (EOFError, ConnectionError):  # it has ended itself
            del own.loaded[self.key]
            return self.process.wait()
        finally:
            self.socket.settimeout(None)


def loaded(path, folder):
    mine = vars(own).setdefault("loaded", {})
    if (path, folder) not in mine: mine[path, folder] = Loaded(path, folder)
    return mine[path, folder]


def contents(descriptor):
    with os.fdopen(descriptor, "rb") as file:
        file.seek(0)
        return file.read()


def call(path, words, folder, stdin=subprocess.DEVNULL, stdout=None, here=False):
    """How the command at `path` ends. A stream is a descriptor or "closed"; what goes to no stdout is in the result.

    `here`: no process of its own, for what is wrong and has no more to do than to say so."""
    kept = stdout is None
    if LIBRARY == "":
        return plainly(path, words, folder, stdin, stdout)
    out = os.memfd_create("out") if kept else stdout
    said = os.memfd_create("said")
    nothing = os.open(os.devnull, os.O_RDONLY)
    streams = [stream for stream in (nothing if stdin == subprocess.DEVNULL else stdin, out, said) if stream != "closed"]
    flags = (stdin == "closed") + 2 * (stdout == "closed") + 8 * here
    try:
        status = loaded(path, folder).call([os.path.basename(path), *words], streams, flags)
    finally:
        os.close(nothing)
        text = contents(out) if kept else b"", contents(said)
    return Done(status, *text)


def plainly(path, words, folder, stdin, stdout):
    argv = [path, *words]
    if "closed" in (stdin, stdout):
        shell = 'exec "$@"' + (" <&-" if stdin == "closed" else "") + (" >&-" if stdout == "closed" else "")
        argv = ["sh", "-c", shell, "sh", *argv]
    done = subprocess.run(argv, stdin=subprocess.DEVNULL if stdin == "closed" else stdin,
                          stdout=subprocess.PIPE if stdout in (None, "closed") else stdout, stderr=subprocess.PIPE, timeout=TIMEOUT, cwd=folder)
    return Done(done.returncode, done.stdout or b"", done.stderr)
