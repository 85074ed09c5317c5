// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/vsprite.h - everything in the engine, and its version.
#pragma once

#include "vsprite/action.h"
#include "vsprite/actor.h"
#include "vsprite/body.h"
#include "vsprite/compose.h"
#include "vsprite/events.h"
#include "vsprite/geometry.h"
#include "vsprite/ground.h"
#include "vsprite/image.h"
#include "vsprite/input.h"
#include "vsprite/owner.h"
#include "vsprite/pack.h"
#include "vsprite/policy.h"
#include "vsprite/reload.h"
#include "vsprite/replay.h"
#include "vsprite/result.h"
#include "vsprite/shadow.h"
#include "vsprite/show.h"
#include "vsprite/sprite.h"
#include "vsprite/stream.h"

#define VSPRITE_VERSION_MAJOR 0
#define VSPRITE_VERSION_MINOR 1
#define VSPRITE_VERSION_PATCH 0
#define VSPRITE_VERSION "0.1.0"
