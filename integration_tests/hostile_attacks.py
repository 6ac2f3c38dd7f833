# SPDX-License-Identifier: Apache-2.0
"""The attacks of hostile.py: each a function that does one thing again and again until its time is over, from a process of
its own. Only to 127.0.0.1. Standard library only."""
import base64, collections, gzip, json, multiprocessing, os, random, signal, socket, struct, threading, time

HOST = "127.0.0.1"
MOST = 5000  # connections in a second of an attack
Attack = collections.namedtuple("Attack", "step about threads few_descriptors silent")
attacks = {}


def attack(about, threads=4, few_descriptors=False, silent=False):
    def enter(step):
        attacks[step.__name__] = Attack(step, about, threads, few_descriptors, silent)
        return step
    return enter


def mask(opcode, data):
    """A frame of a WebSocket client (RFC 6455)."""
    length = bytes([0x80 | len(data)]) if len(data) < 126 else bytes([0x80 | 126]) + struct.pack(">H", len(data))
    return bytes([0x80 | opcode]) + length + bytes(4) + data  # masked with zeros


def upgrade(path, token):
    key = base64.b64encode(os.urandom(16)).decode()
    return (f"GET {path} HTTP/1.1\r\nHost: {HOST}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nAuthorization: Bearer {token}\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode()


def head_of(connection):
    """Status of an answer and what has come of it with its header; 0 when the other side has closed."""
    data = b""
    while b"\r\n\r\n" not in data:
        part = connection.recv(65536)
        if not part: return 0, data
        data += part
    return int(data.split(b" ", 2)[1]), data


class Attacker:
    """What an attack needs: ports, tokens, and the count of what it has done."""

    def __init__(self, target):
        self.target, self.lock, self.held, self.begin = target, threading.Lock(), collections.deque(), time.monotonic()
        self.connections = self.sent = self.turn = 0
        self.random = random.Random(1)
        self.statuses, self.broken = collections.Counter(), []

    def connect(self, port="http", receive_buffer=None):
        connection = socket.socket()
        connection.settimeout(5)
        if receive_buffer: connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        try: connection.connect((HOST, self.target["ports"][port]))
        except OSError:
            connection.close()
            raise
        with self.lock:
            self.connections += 1
            early = self.begin + self.connections / MOST - time.monotonic()
        if early > 0: time.sleep(early)
        return connection

    def send(self, connection, data):
        connection.sendall(data)
        with self.lock: self.sent += len(data)

    def note(self, status):
        with self.lock: self.statuses[str(status)] += 1
        return status

    def violation(self, what):
        with self.lock:
            if len(self.broken) < 5 and what not in self.broken: self.broken.append(what)

    def next(self, among):
        with self.lock: self.turn += 1
        return among[self.turn % len(among)]

    def one_of(self, among): return self.random.choice(among)

    def hold(self, most, connection):
        with self.lock:
            self.held.append(connection)
            oldest = self.held.popleft() if len(self.held) > most else None
        if oldest: oldest.close()

    def raw(self, data, port="http"):
        """Status and body of the answer to these bytes."""
        with self.connect(port) as connection:
            try: self.send(connection, data)
            except OSError: pass  # refused before all of it was read: the answer may be there
            status, text = head_of(connection)
            text += connection.recv(65536) if status and text.endswith(b"\r\n\r\n") and b"Content-Length: 0" not in text else b""
        return self.note(status), text

    def ask(self, method, path, body=b"", token=None, headers=""):
        authorization = f"Authorization: Bearer {self.target['tokens'][token]}\r\n" if token else ""
        return self.raw(f"{method} {path} HTTP/1.1\r\nHost: {HOST}\r\n{authorization}{headers}Connection: close\r\n"
                        f"Content-Length: {len(body)}\r\n\r\n".encode() + body)[0]


MANY_KEYS = json.dumps({f"key{i}": 0 for i in range(70000)}).encode()[:1000000]
DEEP = [b"[" * 4096, b'{"a":' * 800, b"[" * 900000]
UNKNOWN = json.dumps({"values": [{"number": "ffffff", "value": i} for i in range(20000)]}).encode()
LONG = b"G1 X1 F100\n" * 90000


@attack("objects with 70,000 keys to the routes that need no login")
def json_keys(me): me.ask("POST", me.one_of(["/api/session", "/api/channels/0/feed-hold", "/api/channels/0/jog-stop"]), MANY_KEYS)


@attack("deep nesting to the routes that need no login")
def json_depth(me): me.ask("POST", me.one_of(["/api/session", "/api/channels/0/jog-stop"]), me.one_of(DEEP))


@attack("bodies of 1 MB by a user")
def json_of_a_user(me):
    me.ask(*me.one_of([("PUT", "/api/parameters", UNKNOWN, "setter"), ("PUT", "/api/parameters", MANY_KEYS, "setter"),
                     ("POST", "/api/plc/force", DEEP[2], "builder"), ("POST", "/api/check/0", LONG, "operator"),
                     ("POST", "/api/channels/0/mdi", MANY_KEYS, "operator")]))


@attack("500 connections that ask nothing", silent=True)
def half_open(me): me.hold(500, me.connect())


@attack("100 connections that ask nothing, with 32 file descriptors left", few_descriptors=True, silent=True)
def few_descriptors(me): me.hold(100, me.connect())


@attack("200 requests a byte at a time")
def slow_writers(me):
    with me.lock: connection = me.held.popleft() if len(me.held) >= 200 else None
    try:
        if connection is None:
            connection = me.connect()
            me.send(connection, me.one_of([b"GET /api/status HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ",
                                         b"POST /api/session HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 4000\r\n\r\n{",
                                         b"POST /api/session HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n\r\nfa0\r\n{"]))
        me.send(connection, b" ")
        me.hold(200, connection)
    finally: time.sleep(0.002)


@attack("100 readers that never read large answers")
def slow_readers(me):
    token = me.target["tokens"]["operator"]
    connection = me.connect(receive_buffer=2048)
    request = "GET {} HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: Bearer " + token + "\r\n\r\n"
    me.send(connection, "".join(request.format(path) for path in ("/api/parameters", "/api/openapi.json", "/api/tools") * 3).encode())
    me.hold(100, connection)


@attack("streams of the page that never read, as many as there can be")
def idle_streams(me):
    connection = me.connect(receive_buffer=2048)
    me.send(connection, upgrade(me.one_of(["/api/stream"] * 3 + ["/api/plc/watch"]), me.target["tokens"]["operator"]))
    if me.note(head_of(connection)[0]) != 101: time.sleep(0.02)
    me.hold(200, connection)


@attack("messages without end on streams of the page")
def stream_flood(me):
    messages = [b'{"order":1,"path":"/api/channels/0/jog-stop","body":{"axis":"X"}}', b"[" * 4000, b'{"order":' * 400,
                json.dumps({f"{i}": i for i in range(300)}).encode(), b'{"order":2,"path":"/api/channels/0/reset","body":{}}']
    with me.connect() as connection:
        me.send(connection, upgrade("/api/stream", me.target["tokens"]["operator"]))
        me.note(head_of(connection)[0])
        for _ in range(500):
            me.send(connection, mask(1, me.one_of(messages)))
            try: connection.recv(1 << 20, socket.MSG_DONTWAIT)
            except BlockingIOError: pass


@attack("XPath of nested counts to the MTConnect agent")
def mtconnect_paths(me):
    nested = "//*[count(//*[count(//*[count(//*)>0])>0])>0]"
    path = me.one_of([nested, "//*[//*[//*]]", "//*" * 300, "//*[contains(" * 40 + "." + ",'a')]" * 40, "(" * 2000 + "//*" + ")" * 2000])
    me.raw(f"GET /{me.one_of(['current', 'sample'])}?path={path.replace(' ', '%20')} HTTP/1.1\r\nHost: {HOST}\r\nConnection: close\r\n\r\n"
           .encode(), "mtconnect")


@attack("streams of the MTConnect agent that never read, as many as there can be")
def mtconnect_streams(me):
    connection = me.connect("mtconnect", receive_buffer=2048)
    me.send(connection, f"GET {me.one_of(['/current', '/sample'])}?interval=0&heartbeat=1 HTTP/1.1\r\nHost: {HOST}\r\n\r\n".encode())
    me.hold(64, connection)
    time.sleep(0.01)


@attack("64 silent Modbus clients", silent=True)
def modbus_idle(me):
    me.hold(64, me.connect("modbus"))
    time.sleep(0.01)


@attack("64 Modbus clients that send half of a request, or none that could be one")
def modbus_halves(me):
    connection = me.connect("modbus")
    me.send(connection, me.one_of([b"\0", struct.pack(">HHHB", 1, 0, 6, 1), b"\xff" * 260]))
    me.hold(64, connection)
    time.sleep(0.01)


@attack("wrong passwords", threads=8)
def login_guesses(me):
    guess = {"name": me.one_of(["miller", "admin", os.urandom(4).hex()]), "password": os.urandom(8).hex()}
    if me.ask("POST", "/api/session", json.dumps(guess).encode()) == 200: me.violation(f"a wrong password for {guess['name']} logs in")


@attack("foreign hosts and origins, two headers Host, path traversal, request smuggling")
def odd_requests(me):
    hold = "POST /api/channels/0/jog-stop HTTP/1.1\r\nHEADER\r\nContent-Length: 12\r\nConnection: close\r\n\r\n" + '{"axis":"X"}'
    refused = [hold.replace("HEADER", header) for header in (
        "Host: evil.example", "Host: 1.2.3.4:80@evil", "Host: [evil]", "Host: 127.0.0.1\r\nHost: evil.example",
        "Host: 127.0.0.1\r\nOrigin: http://evil.example", "Host: 127.0.0.1\r\nOrigin: null")]
    request = me.one_of(refused)
    status = me.raw(request.encode())[0]
    if 200 <= status < 300: me.violation(f"answer {status} to {request[:110]!r}")
    up = me.one_of(["../", "..%2f", "%2e%2e/", "..%5c", "%252e%252e%252f", "....//", "..%00/"])
    path = me.one_of(["/", "/api/programs/", "/api/recordings/", "/api/plc/programs/"]) + up * 6 + me.one_of(["etc/passwd", "users.json"])
    token = me.target["tokens"]["operator"]
    text = me.raw(f"GET {path} HTTP/1.1\r\nHost: {HOST}\r\nAuthorization: Bearer {token}\r\nConnection: close\r\n\r\n".encode())[1]
    if b"root:" in text or b"argon2" in text: me.violation(f"GET {path} reads a file")
    inner = "POST /api/channels/0/reset HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 2\r\n\r\n{}"
    for header in ("Content-Length: 4\r\nTransfer-Encoding: chunked", "Transfer-Encoding: chunked\r\nContent-Length: 400",
                   "Content-Length: 4\r\nContent-Length: 90", "Transfer-Encoding: identity, chunked", "Content-Length: -1"):
        me.raw(f"POST /api/session HTTP/1.1\r\nHost: {HOST}\r\n{header}\r\n\r\n0\r\n\r\n{inner}".encode())


OPEN = ("emergency-stop", "feed-hold", "jog-stop", "/session", "measurement/abort")  # need no login: docs/security.md
OF_SETTERS = ("/api/parameters", "/api/tools", "/api/work-offsets", "/api/programs", "/api/plc/force", "/api/plc/release",
              "/api/plc/load/take-over", "/api/measurement/start", "/api/measurement/confirm", "/api/measurement/undo")


@attack("every route that changes something, without a login and as an operator")
def no_right(me):
    method, path = me.next(me.target["changes"])
    if not path.endswith(OPEN):
        for headers in ("", "Authorization: Bearer 0\r\n", "Cookie: trunnion_session=0\r\n"):
            status = me.ask(method, path, b"{}", headers=headers)
            if status not in (0, 401): me.violation(f"{method} {path} without a login is answered {status}")
    if path.startswith(OF_SETTERS):
        status = me.ask(method, path, b"{}", "operator")
        if status not in (0, 403): me.violation(f"{method} {path} by an operator is answered {status}")


@attack("uploads that are broken off, and compressed bodies")
def uploads(me):
    token = me.target["tokens"]["setter"]
    with me.connect() as connection:
        me.send(connection, f"PUT /api/programs/broken-off.nc HTTP/1.1\r\nHost: {HOST}\r\nAuthorization: Bearer {token}\r\n"
                            f"Content-Length: {100 << 20}\r\n\r\n".encode() + LONG)
    me.ask("POST", "/api/check/0", BOMB, "operator", "Content-Encoding: gzip\r\n")


BOMB = gzip.compress(bytes(100 << 20), 1)[:900000]


def repeat(me, step, end):
    while time.monotonic() < end:
        try: step(me)
        except OSError: time.sleep(0.005)  # closed by the other side, which is an answer too
        except Exception as error:  # an attack that does not know what it does has shown nothing
            me.violation(f"the attack itself has failed: {error!r}")
            raise


def child(name, target, seconds, result):
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    os.nice(10)  # attackers have computers of their own
    me, chosen = Attacker(target), attacks[name]
    end = time.monotonic() + seconds
    threads = [threading.Thread(target=repeat, args=(me, chosen.step, end), daemon=True) for _ in range(chosen.threads)]
    for thread in threads: thread.start()
    while time.monotonic() < end: time.sleep(0.05)  # what is held is held until the end
    for thread in threads: thread.join(10)
    result.send({"connections": me.connections, "sent_bytes": me.sent, "answers": dict(me.statuses), "broken": me.broken})


class Running:
    """An attack in a process of its own, which ends with its time."""

    def __init__(self, name, target, seconds):
        fork = multiprocessing.get_context("fork")
        self.result, there = fork.Pipe(duplex=False)
        self.process = fork.Process(target=child, args=(name, target, seconds, there), daemon=True)
        self.process.start()
        there.close()

    def runs(self): return self.process.is_alive()

    def end(self):
        """What it has done; it is over, or ended when it hangs."""
        done = self.result.recv() if self.result.poll(60) else None
        self.process.terminate()
        self.process.join()
        return done or {"connections": 0, "sent_bytes": 0, "answers": {}, "broken": ["the attack itself has hung for 60 s"]}
