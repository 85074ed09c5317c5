// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Steers a character that `vsprite export --to table` wrote. Any number of them may share `data`,
// the parsed character.json. Call `tick` `data.fps` times a second, then draw `frame()` of
// page `frame().page` with its anchor at (x, y).
class Character {
  constructor(data, mode = data.default_mode) {
    this.data = data;
    this.mode = data.modes[mode];
    this.count = data.samples.length;
    this.state = data.start; // stage * count + sample
    this.shown = 1; // ticks that the sample has been shown
    this.x = this.y = 0; // of the anchor, px
    this.follows = this.bent = this.mode.follow[data.directions.indexOf("none")];
  }

  // direction: index into data.directions: 0 right, clockwise to 7 right+up, 8 none, 9 rest.
  steer(direction) {
    const follows = this.mode.follow[direction];
    if (follows === this.follows) return;
    this.follows = follows;
    this.state = (this.mode.stages - 1) * this.count + this.sample();
  }

  tick() {
    const sample = this.sample();
    this.x += this.mode.dx[this.bent][sample] / this.data.unit;
    this.y += this.mode.dy[this.bent][sample] / this.data.unit;
    this.bent = this.follows;
    if (this.shown < this.data.samples[sample].duration) {
      this.shown += 1;
    } else {
      this.state = this.mode.next[this.follows][this.state];
      this.shown = 1;
    }
  }

  sample() {
    return this.state % this.count;
  }

  frame() {
    return this.data.samples[this.sample()];
  }
}

if (typeof module !== "undefined") module.exports = { Character };
