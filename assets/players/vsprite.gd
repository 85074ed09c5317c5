# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
#
# Steers a character that `vsprite export --to table` wrote (Godot 4). Put character.json and its
# pages into one folder of the project, this script on a Node2D, and set `file`.
extends Node2D

@export_file("*.json") var file: String
var data: Dictionary
var mode: Dictionary
var pages: Array[Texture2D] = []
var state := 0  # stage * count + sample
var shown := 1  # ticks that the sample has been shown
var follows := 0
var bent := 0
var time := 0.0

func _ready() -> void:
	data = JSON.parse_string(FileAccess.get_file_as_string(file))
	mode = data.modes[data.default_mode]
	for page in data.pages:
		pages.append(load(file.get_base_dir().path_join(page.file)))
	state = int(data.start)
	follows = int(mode.follow[8])
	bent = follows

# direction: 0 right, clockwise to 7 right+up, 8 none, 9 rest.
func steer(direction: int) -> void:
	var now := int(mode.follow[direction])
	if now == follows:
		return
	follows = now
	state = (int(mode.stages) - 1) * data.samples.size() + sample()

func tick() -> void:
	position += Vector2(mode.dx[bent][sample()], mode.dy[bent][sample()]) / data.unit
	bent = follows
	if shown < data.samples[sample()].duration:
		shown += 1
	else:
		state = int(mode.next[follows][state])
		shown = 1

func sample() -> int:
	return state % data.samples.size()

func _process(delta: float) -> void:
	time += delta
	while time * data.fps >= 1.0:
		time -= 1.0 / data.fps
		tick()
	queue_redraw()

func _draw() -> void:
	var s: Dictionary = data.samples[sample()]
	draw_texture_rect_region(pages[s.page], Rect2(-s.anchor_x, -s.anchor_y, s.w, s.h),
			Rect2(s.x, s.y, s.w, s.h))
