-- SPDX-FileCopyrightText: 2026 the vsprite authors
-- SPDX-License-Identifier: MIT
--
-- love games/love PACK [SCRIPT FRAMES] - arrow keys steer. With a key script it runs so many ticks,
-- prints the hash of its states, keeps vsprite.png in LÖVE's save folder, and ends.
local ffi, v = require("ffi"), require("vsprite")
local sprite, frames, keys, left, time = nil, nil, nil, nil, 0
local hash, actor = v.make("hash", "make_hash"), ffi.new("vsprite_actor")
local info, picture, at = v.sized("info"), v.sized("picture"), ffi.new("float[2]")

function love.load(args)
  sprite = v.make("sprite", "load_pack", args[1] or "goldfish.vsp")
  frames = v.make("frames", "make_frames", sprite, 0)
  if args[2] then keys, left = v.make("keys", "load_keys", sprite, args[2]), tonumber(args[3]) end
  v.call("get_info", sprite, info)
  v.call("make_actor", sprite, keys and 0 or 320, keys and 0 or 180, 0, 0, actor)
end

local function held(more, less)
  return (love.keyboard.isDown(more) and 1 or 0) - (love.keyboard.isDown(less) and 1 or 0)
end

function love.update(dt)
  time = time + (keys and 1 / info.fps or dt)
  while time >= 1 / info.fps and left ~= 0 do
    time, left = time - 1 / info.fps, left and left - 1
    local direction = v.lib.vsprite_direction_from_axes(held("right", "left"), held("down", "up"))
    if keys then v.call("apply_keys", keys, actor) else v.call("set_direction", sprite, actor, direction) end
    v.call("step", sprite, actor)
    v.call("add_to_hash", hash, actor)
  end
end

function love.draw()
  v.call("get_picture", frames, actor.sample, picture)
  v.call("draw_position", sprite, actor, math.min(time * info.fps, 1), at, at + 1)
  if keys then at[0], at[1] = 320, 180 end
  love.graphics.clear(0.61, 0.77, 0.85)
  love.graphics.setBlendMode("alpha", "premultiplied")
  love.graphics.draw(v.image(picture), at[0], at[1], 0, 1, 1, picture.anchor_x, picture.anchor_y)
  if left ~= 0 then return end
  love.graphics.captureScreenshot(function(shot) shot:encode("png", "vsprite.png") love.event.quit() end)
  print(v.digest(hash))
end
