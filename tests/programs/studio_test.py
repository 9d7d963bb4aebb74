"""mars studio's server as a network sees it: pages, strangers, and what breaks connections. What is behind it here is
little (tests/host/studio/fake_studio.cpp)."""

import signal
import socket
import struct
import subprocess
import time
import zlib

from harness import PROGRAMS, PROMPT, SECONDS, TRIES, ProgramTest, main, needs
from studio_page import Page, Refused, connect, request

FAKE = PROGRAMS / "fake-studio"


class Studio:
    """A studio in a folder of its own; `link` as a person gets it."""

    def __init__(self, folder, *arguments):
        page = folder / "page"
        if not page.exists():
            page.mkdir()
            (page / "index.html").write_text("<!DOCTYPE html><title>MARS</title>")
            (page / "main.js").write_text("// nothing")
            (folder / "secret.js").write_text("secret")
            (page / "out.js").symlink_to("../secret.js")
        self.process = subprocess.Popen([FAKE, "--page", page, "--no-browser", *arguments], cwd=folder, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.said = []
        self.link = None
        for line in self.process.stdout:
            self.said.append(line)
            if line.startswith("Open "):
                self.link = line.split()[1]
            if line.startswith("Ctrl-C"):
                break

    def end(self, number=signal.SIGTERM):
        self.process.send_signal(number)
        _, errors = self.process.communicate(timeout=PROMPT)
        return self.process.returncode, errors

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()


def decoded(picture):
    magic, view, number, low, _, width, height, encoding, flags, rects = struct.unpack_from("<IIIIIHHHHI", picture)
    body = picture[32 + 8 * rects:]
    return {"magic": magic, "view": view, "picture": number, "edit": low, "size": (width, height), "encoding": encoding,
            "flags": flags, "pixels": zlib.decompress(body) if encoding == 1 else body}


class StudioTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.studio = self.enterContext(Studio(self.folder, "--port", "0"))
        self.link = self.studio.link

    def alive(self):
        with Page(self.link) as page:
            return page.hear("project")["shown"] is not None

    def test_page_and_its_headers(self):
        status, headers, body = request(self.link)
        self.assertEqual((status, headers["content-type"]), (200, "text/html; charset=utf-8"))
        self.assertIn(b"MARS", body)
        policy = headers["content-security-policy"]
        self.assertTrue(policy.startswith("default-src 'self';"), policy)
        self.assertNotIn("unsafe", policy)
        self.assertEqual(headers["x-content-type-options"], "nosniff")
        self.assertEqual(request(self.link, If_None_Match=headers["etag"])[0], 304)
        status, headers, body = request(self.link, "/main.js", "HEAD")
        self.assertEqual((status, headers["content-length"], body), (200, "10", b""))

    def test_listens_here_only(self):
        self.assertTrue(self.link.startswith("http://127.0.0.1:"), self.link)
        self.assertGreaterEqual(len(self.link.partition("token=")[2]) * 4, 128)

    def test_files_beside_the_page_stay_ours(self):
        for target in ["/../secret.js", "/out.js", "/%2e%2e/secret.js", "//etc/passwd", "/..", "/.", "/none", "/page/../.."]:
            with self.subTest(target):
                status, _, body = request(self.link, target)
                self.assertEqual(status, 404)
                self.assertNotIn(b"secret", body)

    def test_strangers_are_refused(self):
        for headers in [{"Host": "evil.example"}, {"Host": "evil.example:80"}, {"Origin": "http://evil.example"},
                        {"Origin": "null"}]:
            with self.subTest(headers):
                self.assertEqual(request(self.link, **headers)[0], 403)
                with self.assertRaisesRegex(Refused, "403"):
                    Page(self.link, **headers)
        for token in ["", "0" * 48, self.link[-47:], self.link[-48:] + "0"]:
            with self.subTest(token), self.assertRaisesRegex(Refused, "403"):
                Page(self.link, token=token)
        with self.assertRaisesRegex(Refused, "403"):
            Page(self.link, Origin="")
        self.assertEqual(request(self.link, "/ws?token=" + self.link[-48:])[0], 426)

    def test_methods_bodies_and_headers(self):
        for method in ["POST", "PUT", "DELETE", "OPTIONS", "BREW"]:
            self.assertEqual(request(self.link, "/", method)[0], 405)
        self.assertIn(request(self.link, "/", "GET", Content_Length="5")[0], [400, 413])
        self.assertEqual(request(self.link, "/", "GET", Transfer_Encoding="chunked")[0], 413)
        self.assertEqual(request(self.link, "/" + "x" * 20000)[0], 431)
        self.assertEqual(request(self.link, "/", "GET", Cookie="x" * 20000)[0], 431)
        for garbage in [b"\0" * 100, b"GET\r\n\r\n", b"\x16\x03\x01\x02\x00" * 40, b"GET / HTTP/9.9\r\n\r\n"]:
            with connect(self.link) as stranger:
                stranger.sendall(garbage)
                stranger.shutdown(socket.SHUT_WR)
                self.assertIn(stranger.recv(12)[9:], [b"400", b"403"])
        self.assertTrue(self.alive())

    def test_two_pages_see_one_project(self):
        with Page(self.link) as one, Page(self.link) as other:
            for page in (one, other):
                self.assertEqual(page.hear()["is"], "project")
                self.assertEqual(page.hear()["is"], "state")
            one.say(do="preview", edit=1, step={"set": "first"})
            self.assertEqual(other.hear()["is"], "poses")
            one.say(do="commit", edit=2, step={"set": "second"})
            for page in (one, other):
                self.assertEqual(page.hear("project")["shown"], "second")
            one.say(do="preview", edit=3, step={"set": "third"})
            self.assertEqual(other.hear("poses")["shown"], "third")
            one.close()  # without a word
            self.assertEqual(other.hear("project")["shown"], "cancelled")

    def test_malformed_messages_are_refused_one_by_one(self):
        with Page(self.link) as page:
            page.hear("state")
            for text in [b"", b"{", b"[]", b"{}", b'{"do": 1}', b'{"do": "none"}', b'{"do": "commit"}', b"[" * 60000,
                         b'{"do": "frame", "frame": "x"}', b'{"do": "view", "view": {}, "width": []}', b"\0\1"]:
                page.send_frame(1, text)
                self.assertEqual(page.hear()["is"], "refused", text)
            for _ in range(3000):
                page.send_frame(1, b"nonsense")
            for _ in range(3000):
                self.assertEqual(page.hear()["is"], "refused")
            page.say(do="undo")
            self.assertEqual(page.hear("project")["shown"], "undone")

    def test_what_no_page_sends_ends_it(self):
        for code, frames in [(1003, [(2, b"binary", True)]), (1009, [(1, b"x" * 70000, True)]),
                             (1009, [(1, b"x" * 40000, False), (0, b"x" * 40000, True)]),
                             (1007, [(1, b"\xff\xfe", True)]), (1002, [(3, b"", True)]), (1002, [(0, b"", True)])]:
            with self.subTest(code=code), Page(self.link) as page:
                for frame in frames:
                    page.send_frame(*frame)
                self.assertEqual(page.ending(), code)
        self.assertTrue(self.alive())

    def test_pictures_wait_for_those_before(self):
        with Page(self.link) as page:
            page.hear("state")
            page.say(do="view", edit=1, view=3, width=64, height=48)
            for edit in (2, 3):
                page.say(do="orbit", edit=edit, view=3, moving=True)
            self.assertEqual(page.hear("handles")["picture"], 1)
            first, second = decoded(page.hear("picture")), decoded(page.hear("picture"))
            self.assertEqual((first["magic"], first["view"], first["edit"], first["size"]), (0x5352414d, 3, 1, (64, 48)))
            self.assertEqual((first["flags"], second["flags"], second["picture"]), (3, 2, 2))
            for picture in (first, second):
                self.assertEqual(len(picture["pixels"]), 64 * 48 * 4)
                self.assertEqual(picture["pixels"][:4], bytes([picture["picture"], 0, 40, 255]))
            page.say(do="undo")
            self.assertIn("is", page.hear("project", "picture"))  # the third waits
            page.say(do="painted", view=3, picture=1)
            self.assertEqual(page.hear("remark")["text"], "painted 1")
            self.assertEqual(decoded(page.hear("picture"))["edit"], 3)

    def test_a_page_that_ends_gives_room(self):
        pages = [Page(self.link) for _ in range(16)]
        pages[0].close()
        pages[0] = Page(self.link)
        pages[0].hear("project")
        for page in pages:
            page.close()

    def test_a_page_that_reads_nothing_hinders_nobody(self):
        with Page(self.link) as stuck, Page(self.link) as other:
            stuck.hear("state")
            other.hear("state")
            stuck.say(do="view", edit=1, view=0, width=320, height=240)
            for edit in range(2, 30):
                stuck.say(do="orbit", edit=edit, view=0, moving=True)
            other.say(do="undo")
            self.assertEqual(other.hear("project")["shown"], "undone")
            self.assertIsNone(stuck.ending())  # too much waits for it

    def test_signals_end_it_at_once(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with Studio(self.folder, "--port", "0") as studio, Page(studio.link) as page:
                page.hear("state")
                studio.process.send_signal(number)
                self.assertEqual(page.ending(), 1001)
                self.assertEqual(studio.end(number), (0, ""))

    def end_in_a_step(self, signals):
        """Seconds from the last signal to the studio's end, in a step that takes a minute."""
        with Studio(self.folder, "--port", "0") as studio, Page(studio.link) as page:
            page.hear("state")
            page.say(do="commit", step={"set": "long"})
            self.assertEqual(studio.process.stdout.readline(), "a long step begins\n")
            for _ in range(signals - 1):
                studio.process.send_signal(signal.SIGTERM)
                time.sleep(0.5)
            began = time.monotonic()
            self.assertEqual(studio.end(), (1, "mars: the studio ends in the middle of a step, which is not done\n"))
            return time.monotonic() - began

    def test_a_signal_ends_it_in_the_middle_of_a_step(self):
        self.end_in_a_step(1)

    def test_a_second_signal_ends_it_at_once(self):
        """The first alone would take five seconds. A busy machine may take as long, but not each time."""
        self.assertTrue(any(self.end_in_a_step(2) < 3 for _ in range(TRIES)))


class StartTest(ProgramTest):
    def refused(self, *arguments):
        with Studio(self.folder, *arguments) as studio:
            _, errors = studio.process.communicate(timeout=SECONDS)
            self.assertEqual(studio.process.returncode, 1)
            return errors

    def test_a_port_that_is_taken(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = str(taken.getsockname()[1])
            errors = self.refused("--port", port)
            self.assertIn("in use", errors)
            self.assertIn(f"port {port}", errors)
        with Studio(self.folder) as one, Studio(self.folder) as other:
            self.assertNotEqual(one.link.partition("/?")[0], other.link.partition("/?")[0])
            self.assertEqual(request(other.link)[0], 200)

    def test_other_machines_need_tls_or_a_word(self):
        self.assertIn("--insecure", self.refused("--listen", "0.0.0.0:0"))
        self.assertIn("both", self.refused("--certificate", "x.pem"))
        self.assertIn("no port", self.refused("--listen", "127.0.0.1:x"))
        self.assertIn("no address", self.refused("--listen", "no.such.place", "--insecure"))
        self.assertIn("cannot listen", self.refused("--listen", "203.0.113.7:0", "--insecure"))
        with Studio(self.folder, "--listen", "0.0.0.0:0", "--insecure") as studio:
            self.assertIn("without TLS", studio.end()[1])

    @needs("openssl")
    def test_tls(self):
        made = subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1",
                               "-nodes", "-subj", "/CN=localhost", "-keyout", "key.pem", "-out", "cert.pem"],
                              cwd=self.folder, capture_output=True, timeout=SECONDS)
        self.assertEqual(made.returncode, 0, made.stderr)
        arguments = ["--port", "0", "--certificate", "cert.pem", "--key"]
        with Studio(self.folder, *arguments, "key.pem") as studio:
            self.assertTrue(studio.link.startswith("https://"))
            self.assertIn("wss://", request(studio.link)[1]["content-security-policy"])
            with Page(studio.link) as page:
                page.hear("state")
                page.say(do="view", edit=1, view=0, width=640, height=480)
                self.assertEqual(len(decoded(page.hear("picture"))["pixels"]), 640 * 480 * 4)
                silent = [connect(studio.link.replace("https", "http")) for _ in range(64)]
                self.assertEqual(request(studio.link)[0], 200)  # the oldest of them gave way
                for each in silent:
                    each.close()
                with connect(studio.link.replace("https", "http")) as plain:
                    plain.sendall(b"GET / HTTP/1.1\r\n\r\n")
                    self.assertNotIn(b"200", plain.recv(100))
                page.say(do="undo")
                page.hear("project")
            self.assertEqual(studio.end(), (0, ""))
        self.assertIn("the key cannot be used", self.refused(*arguments, "cert.pem"))
        subprocess.run(["openssl", "ec", "-in", "key.pem", "-aes256", "-passout", "pass:secret", "-out", "locked.pem"],
                       cwd=self.folder, capture_output=True, check=True, timeout=SECONDS)
        locked = self.refused(*arguments, "locked.pem")
        self.assertIn("it is no PEM file without a passphrase", locked)
        self.assertEqual(len(locked.splitlines()), 1, "nobody is asked")
        self.assertIn("none.pem: there is no such file", self.refused(*arguments, "none.pem"))
        self.assertIn("none.pem: there is no such file", self.refused("--certificate", "none.pem", "--key", "key.pem"))
        (self.folder / "text.pem").write_text("no certificate")
        self.assertIn("it is no PEM file of certificates", self.refused("--certificate", "text.pem", "--key", "key.pem"))

    def test_only_files_below_its_folder(self):
        (self.folder / "inner").mkdir()
        (self.folder / "model.json").write_text("{}")
        (self.folder / "inner" / "link.json").symlink_to("../model.json")
        for name in ["../model.json", "link.json", "/etc/passwd"]:
            made = subprocess.run([FAKE, "--page", self.folder, name], cwd=self.folder / "inner", text=True,
                                  capture_output=True, timeout=SECONDS)
            self.assertEqual(made.returncode, 1)
            self.assertIn("not below the folder", made.stderr)
        self.assertIn("cannot be opened", self.refused("none/model.json"))
        self.assertIn("cannot be opened", self.refused("model.jso"))
        self.assertIn("not below the folder", self.refused("../new.json"))

    def test_a_new_model_is_announced(self):
        with Studio(self.folder, "--port", "0") as studio:
            self.assertIn("figure.json is new", studio.said[0])
        with Studio(self.folder, "--port", "0", "walker.json") as studio:
            self.assertIn("walker.json is new", studio.said[0])
        self.assertFalse(list(self.folder.glob("*.json")))


if __name__ == "__main__":
    main()
