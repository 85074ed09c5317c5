-- SPDX-FileCopyrightText: 2026 the vsprite authors
-- SPDX-License-Identifier: MIT
--
-- The whole binding: libvsprite.so.0 hands out its own declarations. VSPRITE_LIB: the library, if
-- it lies elsewhere. lib.vsprite_X is the function of c_api.h; call(...) raises what was wrong.
local ffi = require("ffi")
ffi.cdef("const char* vsprite_cdef(void);")
local lib = ffi.load(os.getenv("VSPRITE_LIB") or "libvsprite.so.0")
ffi.cdef(ffi.string(lib.vsprite_cdef()))

local function call(name, ...)
  if lib["vsprite_" .. name](...) ~= 0 then error(ffi.string(lib.vsprite_last_error()), 0) end
end

-- make("sprite", "load_pack", path): a handle that is closed when nobody needs it any more.
local function make(kind, name, ...)
  local out = ffi.new("vsprite_" .. kind .. "*[1]")
  local arguments = {...}
  arguments[#arguments + 1] = out
  call(name, unpack(arguments))
  return ffi.gc(out[0], function(handle)
    out[0] = handle
    lib["vsprite_close_" .. kind](out)
  end)
end

-- A struct whose struct_size is filled in.
local function sized(kind)
  local struct = ffi.new("vsprite_" .. kind)
  struct.struct_size = ffi.sizeof(struct)
  return struct
end

-- The picture as LÖVE's own; it is premultiplied.
local function image(picture)
  local bytes = ffi.string(picture.rgba, picture.stride * picture.height)
  local data = love.image.newImageData(picture.width, picture.height, "rgba8", bytes)
  return love.graphics.newImage(data)
end

-- Sixteen hex digits.
local function digest(hash)
  local states = ffi.new("uint64_t[1]")
  call("get_hash", hash, states)
  return bit.tohex(states[0])
end

return {lib = lib, call = call, make = make, sized = sized, image = image, digest = digest}
