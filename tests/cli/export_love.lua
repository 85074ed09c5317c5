-- SPDX-FileCopyrightText: 2026 the vsprite authors
-- SPDX-License-Identifier: MIT
--
-- love FOLDER: what `vsprite export --to table` wrote, steered by the player that comes with it.
-- Every sample that it shows is drawn from its page, and kept as sample-000000.png in LÖVE's save
-- folder.
local Character = require("player")

-- A document without brackets in its texts.
local function read_json(name)
  local text = love.filesystem.read(name):gsub("%[", "{"):gsub("%]", "}"):gsub('"([^"]*)":', '["%1"]=')
  return assert(loadstring("return " .. text))()
end

local function keep(frame, pages, name)
  local page = pages[frame.page + 1]
  local quad = love.graphics.newQuad(frame.x, frame.y, frame.w, frame.h, page:getDimensions())
  local canvas = love.graphics.newCanvas(frame.w, frame.h)
  love.graphics.setCanvas(canvas)
  love.graphics.setBlendMode("replace", "premultiplied")
  love.graphics.draw(page, quad)
  love.graphics.setCanvas()
  canvas:newImageData():encode("png", name)
end

function love.load()
  local data, pages, kept = read_json("character.json"), {}, {}
  for k, page in ipairs(data.pages) do
    pages[k] = love.graphics.newImage(page.file)
    assert(pages[k]:getWidth() == page.width and pages[k]:getHeight() == page.height)
  end
  local character = Character.new(data)
  for tick = 0, 239 do
    character:steer(math.floor(tick / 30))
    character:tick()
    local name = string.format("sample-%06d.png", character:sample())
    if not kept[name] then keep(character:frame(), pages, name) end
    kept[name] = true
  end
  love.event.quit()
end
