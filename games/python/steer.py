# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
"""steer.py PACK SCRIPT FRAMES [PICTURE.png] - a character in Python, by ctypes and nothing else:
prints the hash of its states, and draws where it ends. VSPRITE_LIB: the library, if elsewhere."""
import os
import sys
from ctypes import CDLL, byref, c_char_p, c_float, c_int64, c_uint64, c_void_p

lib = CDLL(os.environ.get("VSPRITE_LIB", "libvsprite.so.0"))
lib.vsprite_last_error.restype = c_char_p
Actor = c_int64 * 8  # 64 bytes; the first two numbers are the position in 1/65536 px


def call(name, *arguments):
    if getattr(lib, "vsprite_" + name)(*arguments) != 0:
        sys.exit("steer.py: error: " + lib.vsprite_last_error().decode())


def make(name, *arguments):
    handle = c_void_p()
    call(name, *arguments, byref(handle))
    return handle


if len(sys.argv) < 4:
    sys.exit(__doc__)
sprite = make("load_pack", sys.argv[1].encode())
keys, states = make("load_keys", sprite, sys.argv[2].encode()), make("make_hash")
actor, digest = Actor(), c_uint64()
call("make_actor", sprite, c_float(0), c_float(0), c_uint64(0), 0, byref(actor))
for _ in range(int(sys.argv[3])):
    call("apply_keys", keys, byref(actor))
    call("step", sprite, byref(actor))
    call("add_to_hash", states, byref(actor))
call("get_hash", states, byref(digest))
print(f"{digest.value:016x}")
if len(sys.argv) > 4:
    actor[0], actor[1] = 320 << 16, 180 << 16  # the middle of the picture
    frames, canvas = make("make_frames", sprite, c_uint64(0)), make("make_canvas", 640, 360, 0x9CC4D8)
    call("draw_actor", canvas, frames, byref(actor), c_float(0), c_float(1))
    call("save_canvas", canvas, sys.argv[4].encode())
