/* SPDX-FileCopyrightText: 2026 the vsprite authors
   SPDX-License-Identifier: MIT

   vsprite/c_api.h - the engine for C, and for whatever can call C: LuaJIT, Python, Rust, C#.

   libvsprite.so.0, or the same functions in the static library. C99, also C++. The C++ headers next
   to this one say more about what each call does; the names are theirs.

       vsprite_sprite* sprite = NULL;
       vsprite_actor actor;
       if (vsprite_load_pack("goldfish.vsp", &sprite)) return puts(vsprite_last_error());
       vsprite_make_actor(sprite, 640, 360, 0, 0, &actor);
       vsprite_set_direction(sprite, &actor, VSPRITE_RIGHT);   // whenever the player says so
       vsprite_step(sprite, &actor);                           // once a tick
       vsprite_close_sprite(&sprite);

   Errors. Every call that returns vsprite_status returns VSPRITE_OK (0) or the code of what was
   wrong, and then does nothing: a null pointer, a handle that is closed (null) or of another kind,
   an index out of range, a number that is not finite, an actor in a state that the sprite does not
   know are VSPRITE_BAD_ARGUMENT. Nothing is thrown, printed or logged. The sentence that belongs to
   the code is kept for each thread (vsprite_last_error). There is no other state but in handles.

   Handles are made by load and make calls, which write them through their last argument (null if
   they fail), and end by close calls, which take the address of your variable and set it to null. A
   second copy of a closed handle is not detectable in general. Frames, keys, recordings and replays
   keep the sprite that they were made with; it may be closed before them.

   Sized structs. Set `struct_size` to sizeof the struct before each call. A smaller one, of an
   older header, is read as far as it goes. A larger one, of a later header, is taken if what this
   library does not know of it is 0, else VSPRITE_UNSUPPORTED_VERSION; where the library writes,
   that part is set to 0.

   Threads. A sprite may be used by any number of threads. An actor, and every other handle, by one
   thread at a time.

   Units: pixels, x right, y down; seconds; angles clockwise from +x; pictures RGBA8, premultiplied,
   rows from top to bottom. */
#ifndef VSPRITE_C_API_H
#define VSPRITE_C_API_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define VSPRITE_API
#else
#define VSPRITE_API __attribute__((visibility("default")))
#endif
#ifdef __cplusplus
extern "C" {
#endif
/* vsprite_cdef() hands out what follows, up to the line "end of the declarations". */

typedef int32_t vsprite_status;
enum {
  VSPRITE_OK = 0,
  VSPRITE_NOT_FOUND = 1,           /* no such file or name */
  VSPRITE_CANNOT_READ = 2,         /* the file is there, or the callback, and reading failed */
  VSPRITE_CANNOT_CREATE = 3,       /* a file cannot be made */
  VSPRITE_CANNOT_WRITE = 4,        /* writing failed (also a full disk) */
  VSPRITE_IN_USE = 5,              /* another process holds it */
  VSPRITE_BAD_FORMAT = 6,          /* not a pack */
  VSPRITE_UNSUPPORTED_VERSION = 7, /* of a version that this library does not know */
  VSPRITE_CORRUPT_DATA = 8,        /* damaged or contradictory content */
  VSPRITE_LIMIT_EXCEEDED = 9,      /* larger than the documented limit */
  VSPRITE_BAD_CONTENT = 10,        /* well-formed, but not usable for the purpose */
  VSPRITE_BAD_SETTING = 11,        /* what a user wrote (a key script) cannot be understood */
  VSPRITE_DECODER_FAILED = 12,
  VSPRITE_UNAVAILABLE = 13, /* this build or machine lacks it */
  VSPRITE_OUT_OF_MEMORY = 14,
  VSPRITE_INTERRUPTED = 15,
  VSPRITE_INTERNAL = 16,
  VSPRITE_BAD_ARGUMENT = 17 /* the call was wrong */
};

/* What an actor is told to do. */
enum {
  VSPRITE_RIGHT = 0,
  VSPRITE_RIGHT_DOWN = 1,
  VSPRITE_DOWN = 2,
  VSPRITE_LEFT_DOWN = 3,
  VSPRITE_LEFT = 4,
  VSPRITE_LEFT_UP = 5,
  VSPRITE_UP = 6,
  VSPRITE_RIGHT_UP = 7,
  VSPRITE_NONE = 8, /* carries on by itself */
  VSPRITE_REST = 9
};

/* A canvas's colour beside 0xRRGGBB: none, alpha 0. */
enum { VSPRITE_CLEAR = 0x1000000 };

/* What is done to an actor, for a recording. */
enum {
  VSPRITE_DO_DIRECTION = 0, /* vsprite_set_direction(direction) */
  VSPRITE_DO_HEADING = 1,   /* vsprite_set_heading(x, y) */
  VSPRITE_DO_TARGET = 2,    /* vsprite_set_target(x, y, radius) */
  VSPRITE_DO_PLAY = 3,      /* vsprite_play(action, within, hold) */
  VSPRITE_DO_QUEUE = 4,     /* vsprite_queue(action, hold) */
  VSPRITE_DO_RELEASE = 5,   /* vsprite_release(within) */
  VSPRITE_DO_CANCEL = 6,    /* vsprite_cancel() */
  VSPRITE_DO_FOLLOW = 7,    /* vsprite_follow(x, y) */
  VSPRITE_DO_SCALED = 8,    /* vsprite_own_scaled(x, y) */
  VSPRITE_DO_RECORDED = 9   /* vsprite_own_recorded() */
};

/* What a sprite has names of. */
enum { VSPRITE_MODE = 0, VSPRITE_ACTION = 1, VSPRITE_EVENT = 2, VSPRITE_TAG = 3 };

typedef struct vsprite_sprite vsprite_sprite;       /* a loaded pack; never changes */
typedef struct vsprite_frames vsprite_frames;       /* decoded pictures within a budget */
typedef struct vsprite_keys vsprite_keys;           /* a key script */
typedef struct vsprite_hash vsprite_hash;           /* a running hash of states */
typedef struct vsprite_canvas vsprite_canvas;       /* a picture to draw on */
typedef struct vsprite_recording vsprite_recording; /* a run that is being recorded */
typedef struct vsprite_replay vsprite_replay;       /* a recorded run that is made again */
typedef struct vsprite_puppets vsprite_puppets;     /* the puppets of a pack */

/* One character: 64 plain bytes. Copy them to save it, copy them back to roll back, send them; what
   comes from a file or a network is checked by vsprite_check_actor (and by every call). Read what
   you like; write `x` and `y` if you like. */
typedef struct vsprite_actor {
  int64_t x, y;  /* position of the anchor, 1/65536 px */
  uint64_t tick; /* steps since it was made */
  uint32_t random;
  uint32_t sample; /* shown now */
  uint16_t shown;  /* ticks that it has been shown */
  uint8_t mode, direction, group, bent, stage, table;
  uint8_t jumped; /* 1: `sample` is not the film's own continuation */
  uint8_t skipped, play, owner;
  uint16_t action; /* played now: 1 + its index; 0: it is steered */
  uint16_t queued, due, clock;
  int16_t offset_x, offset_y;
  int32_t drive_x, drive_y;
} vsprite_actor;

/* Your memory: all that the handle and what is made from it take, from the load call on, but for
   thread stacks. `allocate` gets a power of two as `alignment` and returns null where there is none
   (the call then returns VSPRITE_OUT_OF_MEMORY); `release` gets back what it was asked for. Both
   are called by any thread that uses the handle, and by the decoding thread. Copied. */
typedef struct vsprite_allocator {
  uint32_t struct_size;
  void* user;
  void* (*allocate)(void* user, size_t bytes, size_t alignment);
  void (*release)(void* user, void* memory, size_t bytes, size_t alignment);
} vsprite_allocator;

/* Where a pack lies, one of three: a file; memory, which must stay as it is until the sprite and
   all that was made from it are closed; or calls of yours. `read` fills `out` with the bytes from
   `offset` on and returns 0, or anything else where it cannot; any thread may call it. `close`, may
   be null, is called once, when nothing will be read any more, also if loading fails; not if the
   call's arguments were refused. */
typedef struct vsprite_source {
  uint32_t struct_size;
  const char* path;   /* UTF-8, or null */
  const void* memory; /* or null */
  uint64_t bytes;     /* of the pack, where it does not lie in a file */
  void* user;
  int32_t (*read)(void* user, uint64_t offset, void* out, size_t bytes); /* or null */
  void (*close)(void* user);
} vsprite_source;

typedef struct vsprite_info {
  uint32_t struct_size;
  uint32_t samples, kept; /* of the film, and those that are shown */
  uint32_t transitions;
  uint32_t modes, actions, events, tags; /* names of each kind */
  uint32_t start_sample;
  uint32_t served;     /* bit d: direction d can be travelled, in the first mode */
  double fps;          /* ticks per second */
  float body_length;   /* px */
  uint32_t most_width; /* of any picture */
  uint32_t most_height;
  uint64_t identity; /* of the pack's bytes */
} vsprite_info;

typedef struct vsprite_sample {
  uint32_t struct_size;
  float anchor_x, anchor_y;     /* px from the picture's top left */
  float velocity_x, velocity_y; /* px/s */
  uint32_t width, height;       /* 0 of a sample that is not kept */
  uint32_t duration;            /* ticks */
  uint32_t tag, clip, frame;    /* index; number; frame of the film */
  uint32_t kept;
} vsprite_sample;

/* A decoded picture; draw its anchor at vsprite_draw_position. */
typedef struct vsprite_picture {
  uint32_t struct_size;
  uint32_t width, height; /* 0 only if no picture was ever good */
  uint32_t stride;        /* bytes from row to row */
  const uint8_t* rgba;    /* until the next call but one with these frames */
  float anchor_x, anchor_y;
} vsprite_picture;

typedef struct vsprite_frames_stats {
  uint32_t struct_size;
  uint64_t hits, misses, ahead, damaged; /* pictures */
  uint64_t bytes;                        /* held now */
} vsprite_frames_stats;

typedef struct vsprite_sample_event {
  uint32_t sample, name; /* index of the event's name */
} vsprite_sample_event;

/* What happened in the last step. */
typedef struct vsprite_tick_events {
  uint32_t struct_size;
  uint32_t frame_shown; /* 1: another picture than in the tick before */
  uint32_t jump_taken;  /* 1: and not the film's own continuation: cross-fade it */
  uint32_t named_count;
  const vsprite_sample_event* named; /* of what was shown; lives as long as the sprite */
} vsprite_tick_events;

/* A step's wishes (actor.h, StepWish). */
typedef struct vsprite_wish {
  uint32_t struct_size;
  float slack;  /* >= 0: how much dearer counts as nearly as good, 1 = the threshold */
  int32_t pace; /* 0 any, 1 slow, 2 fast */
  float (*clearance)(const void* world, float x, float y); /* room around a position, or null */
  const void* world;
} vsprite_wish;

typedef struct vsprite_box {
  float left, top, right, bottom; /* px */
} vsprite_box;

/* What still shows of the run before a jump (show.h): plain bytes beside the actor, which decide
   nothing. Copy them with it. */
typedef struct vsprite_fade {
  uint32_t shown, before; /* sample; 0xFFFFFFFF: none */
  uint16_t held;          /* ticks that `before` has been shown */
  uint8_t length, passed; /* ticks */
} vsprite_fade;

/* A picture and where it goes, for a renderer of your own. */
typedef struct vsprite_shown {
  uint32_t struct_size;
  uint32_t sample;        /* names the picture, for a cache of textures */
  uint32_t width, height; /* 0: there is nothing to draw */
  uint32_t stride;        /* bytes from row to row */
  const uint8_t* rgba;    /* premultiplied; until the next call with these frames */
  float left, top;        /* where its corner goes, px, not rounded */
  float opacity;          /* 0 to 1 */
} vsprite_shown;

/* Only what its `kind` takes is read. */
typedef struct vsprite_command {
  uint32_t struct_size;
  int32_t kind; /* VSPRITE_DO_... */
  int32_t direction;
  uint32_t action;
  int32_t within, hold;
  float x, y, radius;
} vsprite_command;

typedef struct vsprite_replay_info {
  uint32_t struct_size;
  uint32_t same_pack; /* 1: it was recorded with these very bytes */
  uint64_t ticks, actors;
} vsprite_replay_info;

typedef struct vsprite_replay_report {
  uint32_t struct_size;
  uint32_t same_pack; /* 1: it was recorded with these very bytes */
  uint64_t ticks, actors;
  uint64_t diverged_tick; /* 0: every tick came out as recorded */
  uint64_t states_hash;   /* of the first actor */
} vsprite_replay_report;

/* Names live as long as the puppets. */
typedef struct vsprite_puppet_info {
  uint32_t struct_size;
  uint32_t parameters, points, faces, views, links;
  const char* name;
} vsprite_puppet_info;

typedef struct vsprite_parameter {
  uint32_t struct_size;
  const char* name;
  double low, high; /* what the examples span; beyond it the nearest is drawn */
  double period;    /* of a cyclic one, else 0 */
} vsprite_parameter;

typedef struct vsprite_pose {
  uint32_t struct_size;
  uint32_t points;
  const float* xy;          /* x and y of each about the barycentre, px; until the next pose */
  float center_x, center_y; /* where the barycentre is by itself, px */
  double outside;           /* how far the parameters lay outside the examples' hull */
} vsprite_pose;

/* -- the library -- */
VSPRITE_API uint32_t vsprite_version(void); /* 0x000100 is 0.1.0 */
/* The sentence of the calling thread's last failure; "" before one. Valid until its next failure.
 */
VSPRITE_API const char* vsprite_last_error(void);
VSPRITE_API const char* vsprite_status_name(vsprite_status status); /* "NOT_FOUND"; "?" */
/* These declarations without comments, as LuaJIT's ffi.cdef wants them. */
VSPRITE_API const char* vsprite_cdef(void);

/* -- packs: the codes of load_pack (pack.h), and VSPRITE_UNAVAILABLE for an allocator in a build
   that does not take one (the static library; sanitizers) -- */
VSPRITE_API vsprite_status vsprite_load_pack(const char* path, vsprite_sprite** sprite);
VSPRITE_API vsprite_status vsprite_load_pack_from(const vsprite_source* source,
                                                  const vsprite_allocator* allocator, /* or null */
                                                  vsprite_sprite** sprite);
VSPRITE_API vsprite_status vsprite_close_sprite(vsprite_sprite** sprite);
/* Checks every byte. VSPRITE_CORRUPT_DATA, and the first finding as the error's text, where
   something is wrong; `issues`, may be null, gets how many findings. */
VSPRITE_API vsprite_status vsprite_verify_pack(const vsprite_source* source, uint32_t* issues);
VSPRITE_API vsprite_status vsprite_get_info(const vsprite_sprite* sprite, vsprite_info* info);
VSPRITE_API vsprite_status vsprite_get_sample(const vsprite_sprite* sprite, uint32_t sample,
                                              vsprite_sample* out);
/* Names live as long as the sprite. VSPRITE_NOT_FOUND where there is no such name. */
VSPRITE_API vsprite_status vsprite_get_name(const vsprite_sprite* sprite, int32_t kind,
                                            uint32_t index, const char** name);
VSPRITE_API vsprite_status vsprite_find(const vsprite_sprite* sprite, int32_t kind,
                                        const char* name, uint32_t* index);

/* -- actors -- */
VSPRITE_API vsprite_status vsprite_make_actor(const vsprite_sprite* sprite, float x, float y,
                                              uint64_t seed, uint32_t mode, vsprite_actor* actor);
/* VSPRITE_BAD_ARGUMENT where these bytes are no state of this sprite's. */
VSPRITE_API vsprite_status vsprite_check_actor(const vsprite_sprite* sprite,
                                               const vsprite_actor* actor);
VSPRITE_API vsprite_status vsprite_set_direction(const vsprite_sprite* sprite, vsprite_actor* actor,
                                                 int32_t direction);
/* The direction of held keys: each axis negative, 0 or positive; VSPRITE_NONE for (0, 0). */
VSPRITE_API int32_t vsprite_direction_from_axes(int32_t x, int32_t y);
VSPRITE_API vsprite_status vsprite_set_heading(const vsprite_sprite* sprite, vsprite_actor* actor,
                                               float x, float y);
/* Every tick; rests within `arrive_radius` px. */
VSPRITE_API vsprite_status vsprite_set_target(const vsprite_sprite* sprite, vsprite_actor* actor,
                                              float x, float y, float arrive_radius);
/* One tick: takes no memory, no lock and no file. */
VSPRITE_API vsprite_status vsprite_step(const vsprite_sprite* sprite, vsprite_actor* actor);
/* Of each of `count`; where one is in no valid state, none moves. 0 of them is no error. */
VSPRITE_API vsprite_status vsprite_step_many(const vsprite_sprite* sprite, vsprite_actor* actors,
                                             size_t count);
VSPRITE_API vsprite_status vsprite_step_wish(const vsprite_sprite* sprite, vsprite_actor* actor,
                                             const vsprite_wish* wish);
VSPRITE_API vsprite_status vsprite_draw_position(const vsprite_sprite* sprite,
                                                 const vsprite_actor* actor, float fraction,
                                                 float* x, float* y);
VSPRITE_API vsprite_status vsprite_get_events(const vsprite_sprite* sprite,
                                              const vsprite_actor* actor,
                                              vsprite_tick_events* events);

/* -- actions (action.h): `within` in ticks, 0..65535, or -1: no deadline -- */
VSPRITE_API vsprite_status vsprite_play(const vsprite_sprite* sprite, vsprite_actor* actor,
                                        uint32_t action, int32_t within, int32_t hold);
VSPRITE_API vsprite_status vsprite_queue(const vsprite_sprite* sprite, vsprite_actor* actor,
                                         uint32_t action, int32_t hold);
VSPRITE_API vsprite_status vsprite_release(const vsprite_sprite* sprite, vsprite_actor* actor,
                                           int32_t within);
VSPRITE_API vsprite_status vsprite_cancel(const vsprite_sprite* sprite, vsprite_actor* actor);

/* -- who moves it (owner.h): the game at `x`, `y` px/s; the film times a factor; the film -- */
VSPRITE_API vsprite_status vsprite_follow(const vsprite_sprite* sprite, vsprite_actor* actor,
                                          float x, float y);
VSPRITE_API vsprite_status vsprite_own_scaled(const vsprite_sprite* sprite, vsprite_actor* actor,
                                              float x, float y);
VSPRITE_API vsprite_status vsprite_own_recorded(const vsprite_sprite* sprite, vsprite_actor* actor);

/* -- pictures (stream.h): `budget` in bytes of RGBA, 0: 64 MiB -- */
VSPRITE_API vsprite_status vsprite_make_frames(vsprite_sprite* sprite, uint64_t budget,
                                               vsprite_frames** frames);
VSPRITE_API vsprite_status vsprite_close_frames(vsprite_frames** frames);
VSPRITE_API vsprite_status vsprite_get_picture(vsprite_frames* frames, uint32_t sample,
                                               vsprite_picture* picture);
/* The shadow filmed with a sample (shadow.h): black, to be drawn under its picture, anchor on
   anchor and enlarged by `scale`; width 0: it has none. Valid until the next call with these
   frames. */
VSPRITE_API vsprite_status vsprite_get_shadow(vsprite_frames* frames, uint32_t sample,
                                              vsprite_picture* shadow, float* scale);
VSPRITE_API vsprite_status vsprite_look_ahead(vsprite_frames* frames, const vsprite_actor* actor);
VSPRITE_API vsprite_status vsprite_get_frames_stats(const vsprite_frames* frames,
                                                    vsprite_frames_stats* stats);

/* -- where it is (body.h): drawn `scale` times as large -- */
VSPRITE_API vsprite_status vsprite_body_box(const vsprite_sprite* sprite,
                                            const vsprite_actor* actor, float scale,
                                            vsprite_box* box);
VSPRITE_API vsprite_status vsprite_drawn_box(const vsprite_sprite* sprite,
                                             const vsprite_actor* actor, float scale,
                                             vsprite_box* box);
/* `is_hit` gets 1 where the shown picture covers (x, y) with at least this alpha (0..255). */
VSPRITE_API vsprite_status vsprite_hit(vsprite_frames* frames, const vsprite_actor* actor, float x,
                                       float y, float scale, int32_t alpha, int32_t* is_hit);

/* -- showing (show.h): premultiplied pixels and their place, for a renderer of your own -- */
VSPRITE_API vsprite_status vsprite_start_fade(vsprite_fade* fade); /* nothing fades */
/* After every step. `ticks` of a fade: 0 none, 2 to 6, or -1: by what the jump costs. */
VSPRITE_API vsprite_status vsprite_follow_jumps(const vsprite_sprite* sprite,
                                                const vsprite_actor* actor, vsprite_fade* fade,
                                                int32_t ticks);
/* The actor's picture, `fraction` in [0, 1] of a tick after its last step, and the one that fades
   out, to be drawn over it with its opacity. Has the next ones decoded ahead. `fade` and `fading`,
   or both null. */
VSPRITE_API vsprite_status vsprite_show(vsprite_frames* frames, const vsprite_actor* actor,
                                        const vsprite_fade* fade, float fraction,
                                        vsprite_shown* shown, vsprite_shown* fading);

/* -- key scripts (input.h): "0 right; 2.5 right+up; 3 play jump 4", or the name of a file -- */
VSPRITE_API vsprite_status vsprite_load_keys(vsprite_sprite* sprite, const char* script,
                                             vsprite_keys** keys);
VSPRITE_API vsprite_status vsprite_close_keys(vsprite_keys** keys);
/* Does to the actor what the script says of its tick; call it before each step. */
VSPRITE_API vsprite_status vsprite_apply_keys(const vsprite_keys* keys, vsprite_actor* actor);

/* -- the same run everywhere -- */
VSPRITE_API vsprite_status vsprite_make_hash(vsprite_hash** hash);
VSPRITE_API vsprite_status vsprite_close_hash(vsprite_hash** hash);
VSPRITE_API vsprite_status vsprite_add_to_hash(vsprite_hash* hash, const vsprite_actor* actor);
/* What `vsprite steer` prints as states_hash, if it was given the actor after every step. */
VSPRITE_API vsprite_status vsprite_get_hash(const vsprite_hash* hash, uint64_t* states_hash);
/* Of the bytes of many actors: what two machines compare. */
VSPRITE_API vsprite_status vsprite_hash_actors(const vsprite_actor* actors, size_t count,
                                               uint64_t* hash);
/* Makes a recorded run (.vsr) again. The codes of load_replay (replay.h). */
VSPRITE_API vsprite_status vsprite_run_replay(const vsprite_sprite* sprite, const char* path,
                                              vsprite_replay_report* report);

/* -- recordings (replay.h): of `count` actors, from what they are now -- */
VSPRITE_API vsprite_status vsprite_make_recording(vsprite_sprite* sprite,
                                                  const vsprite_actor* actors, size_t count,
                                                  vsprite_recording** recording);
VSPRITE_API vsprite_status vsprite_close_recording(vsprite_recording** recording);
/* Does it to the actor, the recording's number `index`, and notes it. */
VSPRITE_API vsprite_status vsprite_record_command(vsprite_recording* recording, uint32_t index,
                                                  vsprite_actor* actor,
                                                  const vsprite_command* command);
/* What vsprite_apply_keys does, noted. The keys are of the recording's sprite. */
VSPRITE_API vsprite_status vsprite_record_keys(vsprite_recording* recording, uint32_t index,
                                               vsprite_actor* actor, const vsprite_keys* keys);
/* After every step of all of them. */
VSPRITE_API vsprite_status vsprite_record_tick(vsprite_recording* recording,
                                               const vsprite_actor* actors, size_t count);
/* Writes what was recorded so far (.vsr); the file appears complete, or not at all. */
VSPRITE_API vsprite_status vsprite_save_recording(const vsprite_recording* recording,
                                                  const char* path);
/* A recording, made again tick by tick. The codes of load_replay (replay.h). */
VSPRITE_API vsprite_status vsprite_load_replay(vsprite_sprite* sprite, const char* path,
                                               vsprite_replay** replay);
VSPRITE_API vsprite_status vsprite_close_replay(vsprite_replay** replay);
VSPRITE_API vsprite_status vsprite_get_replay(const vsprite_replay* replay,
                                              vsprite_replay_info* info);
/* Back to its start; `actors` gets all of them. */
VSPRITE_API vsprite_status vsprite_start_replay(vsprite_replay* replay, vsprite_actor* actors,
                                                size_t count);
/* One tick. VSPRITE_BAD_CONTENT where it is not what was recorded, `actors` being what was found;
   VSPRITE_BAD_ARGUMENT after its last tick. */
VSPRITE_API vsprite_status vsprite_step_replay(vsprite_replay* replay, vsprite_actor* actors,
                                               size_t count);

/* -- drawing without a graphics library (compose.h), 1 to 16384 px a side; colour 0xRRGGBB or
   VSPRITE_CLEAR -- */
VSPRITE_API vsprite_status vsprite_make_canvas(uint32_t width, uint32_t height, uint32_t colour,
                                               vsprite_canvas** canvas);
VSPRITE_API vsprite_status vsprite_close_canvas(vsprite_canvas** canvas);
VSPRITE_API vsprite_status vsprite_clear_canvas(vsprite_canvas* canvas, uint32_t colour);
/* `fraction` in [0, 1] of a tick after the last step. */
VSPRITE_API vsprite_status vsprite_draw_actor(vsprite_canvas* canvas, vsprite_frames* frames,
                                              const vsprite_actor* actor, float fraction,
                                              float scale);
VSPRITE_API vsprite_status vsprite_get_canvas(const vsprite_canvas* canvas,
                                              vsprite_picture* picture);
VSPRITE_API vsprite_status vsprite_save_canvas(const vsprite_canvas* canvas, const char* path);

/* -- puppets (puppet.h): characters made of a few views, moved by their parameters. None in the
   pack is no error. The codes of load_puppets -- */
VSPRITE_API vsprite_status vsprite_load_puppets(const char* path, vsprite_puppets** puppets);
VSPRITE_API vsprite_status vsprite_close_puppets(vsprite_puppets** puppets);
VSPRITE_API vsprite_status vsprite_count_puppets(const vsprite_puppets* puppets, uint32_t* count);
VSPRITE_API vsprite_status vsprite_find_puppet(const vsprite_puppets* puppets, const char* name,
                                               uint32_t* puppet);
VSPRITE_API vsprite_status vsprite_get_puppet(const vsprite_puppets* puppets, uint32_t puppet,
                                              vsprite_puppet_info* info);
VSPRITE_API vsprite_status vsprite_get_parameter(const vsprite_puppets* puppets, uint32_t puppet,
                                                 uint32_t parameter, vsprite_parameter* out);
/* `values`: one for each of its parameters, `count` of them. */
VSPRITE_API vsprite_status vsprite_pose_puppet(vsprite_puppets* puppets, uint32_t puppet,
                                               const double* values, uint32_t count,
                                               vsprite_pose* pose);
/* Poses it and draws it with its barycentre at (x, y), `scale` times as large. A canvas that was
   VSPRITE_CLEAR then holds the premultiplied picture (vsprite_get_canvas). */
VSPRITE_API vsprite_status vsprite_draw_puppet(vsprite_canvas* canvas, vsprite_puppets* puppets,
                                               uint32_t puppet, const double* values,
                                               uint32_t count, float x, float y, float scale);
/* The angles, radians clockwise from +x, of an arm of two links that reaches for the target: of the
   upper one, and of the lower one from the upper; `bend` > 0 or < 0 says which way it bends. */
VSPRITE_API vsprite_status vsprite_reach_for(float shoulder_x, float shoulder_y, float target_x,
                                             float target_y, double upper, double lower,
                                             int32_t bend, double* shoulder, double* elbow);

/* end of the declarations */
#ifdef __cplusplus
}
#endif
#endif
