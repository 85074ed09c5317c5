-- SPDX-FileCopyrightText: 2026 the vsprite authors
-- SPDX-License-Identifier: MIT
function love.conf(t)
  t.window.title, t.window.width, t.window.height = "vsprite", 640, 360
  t.modules.audio, t.modules.sound, t.modules.physics = false, false, false
end
