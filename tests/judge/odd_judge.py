"""Judges for tests, good and odd: odd_judge.py MODE [FILE]. The score is the number of triangles of the mesh, / 100."""
import json
import os
import struct
import sys
import time

mode = sys.argv[1]
held = []


def say(text):
    print(text, flush=True)


def score(request):
    with open(request["mesh"], "rb") as mesh:
        return struct.unpack("<I", mesh.read(84)[80:])[0] / 100


if mode == "chatty":  # more than a pipe holds, before it reads a word
    for i in range(4000):
        say("thinking hard about number %06d ......................" % i)
if mode == "deaf":
    say("not in the mood")
    sys.exit(3)
if mode == "stays":
    with open(sys.argv[2], "w") as file:
        file.write(str(os.getpid()))
for line in sys.stdin:
    request = json.loads(line)
    answer = json.dumps({"id": request["id"], "score": score(request)})
    if mode == "backwards":  # batches of three
        held.append(answer)
        if len(held) == 3:
            say("\n".join(reversed(held)))
            held = []
    elif mode == "words":
        word = {"nan": "NaN", "inf": "-Infinity", "null": "null", "text": '"good"', "big": "1e308"}.get(request["name"])
        say('{"id": %d}' % request["id"] if word is None else '{"id": %d, "score": %s}' % (request["id"], word))
    elif mode == "fragile" and request["name"] == "bad":
        sys.exit(5)
    elif mode == "sleepy" and request["name"] == "bad":
        pass
    elif mode == "hangs" and request["name"] == "bad":
        time.sleep(1000)
    elif mode == "echo":
        say(json.dumps({"id": request["id"], "score": request["metres_per_unit"]}))
        say(json.dumps({"id": request["id"], "score": 7}))
        say('{"id": 99999, "score": 7}')
    elif mode == "stays":
        say(answer)
    else:
        say(answer)
if mode == "stays":
    time.sleep(1000)
