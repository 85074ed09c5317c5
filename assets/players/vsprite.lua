-- SPDX-FileCopyrightText: 2026 the vsprite authors
-- SPDX-License-Identifier: MIT
--
-- Steers a character that `vsprite export --to table` wrote. Any number of them may share `data`,
-- the decoded character.json (arrays from 1, as every JSON library for Lua makes them). Call `tick`
-- `data.fps` times a second, then draw `frame()` of page `frame().page` (from 0) with its anchor at
-- (x, y).
local Character = {}
Character.__index = Character

function Character.new(data, mode)
  local self = setmetatable({data = data}, Character)
  self.mode = data.modes[mode or data.default_mode]
  self.count = #data.samples
  self.state = data.start -- stage * count + sample
  self.shown = 1 -- ticks that the sample has been shown
  self.x, self.y = 0, 0 -- of the anchor, px
  self.follows = self.mode.follow[8 + 1] -- none
  self.bent = self.follows
  return self
end

-- direction: 0 right, clockwise to 7 right+up, 8 none, 9 rest.
function Character:steer(direction)
  local follows = self.mode.follow[direction + 1]
  if follows == self.follows then return end
  self.follows = follows
  self.state = (self.mode.stages - 1) * self.count + self:sample()
end

function Character:tick()
  local sample = self:sample()
  self.x = self.x + self.mode.dx[self.bent + 1][sample + 1] / self.data.unit
  self.y = self.y + self.mode.dy[self.bent + 1][sample + 1] / self.data.unit
  self.bent = self.follows
  if self.shown < self:frame().duration then
    self.shown = self.shown + 1
  else
    self.state = self.mode.next[self.follows + 1][self.state + 1]
    self.shown = 1
  end
end

function Character:sample() return self.state % self.count end

function Character:frame() return self.data.samples[self:sample() + 1] end

return Character
