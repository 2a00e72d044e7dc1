"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// Time: it runs, stops and is moved by hand.

const HOLD = 2;  // s that the last frame stays before it begins anew, unless it leads on to the first

class Player {
  constructor(run, changed) {
    Object.assign(this, { run, changed, frame: 0, playing: false, speed: 1, held: 0 });
    this.slider = byName("frame");
    this.slider.max = run.frames - 1;
    this.slider.addEventListener("input", () => this.seek(Number(this.slider.value)));
    byName("play").addEventListener("click", () => this.toggle());
    byName("speed").addEventListener("change", ({ target }) => { this.speed = Number(target.value); });
    this.show();
  }

  get last() {
    return this.run.frames - 1;
  }

  toggle(on = !this.playing) {
    this.playing = on;
    if (on && this.frame >= this.last) this.frame = 0;
    this.held = 0;
    this.show();
  }

  seek(frame) {
    this.playing = false;
    this.frame = Math.min(Math.max(frame, 0), this.last);
    this.show();
  }

  step(frames) {
    this.seek(Math.round(this.frame) + frames);
  }

  advance(seconds) {
    if (!this.playing) return;
    const next = this.frame + seconds * this.speed * this.run.rate;
    this.frame = this.run.loops ? next % this.run.frames : Math.min(next, this.last);
    if (!this.run.loops && this.frame >= this.last && (this.held += seconds) > HOLD) this.frame = this.held = 0;
    this.show();
  }

  show() {
    const frame = Math.min(Math.round(this.frame), this.last), seconds = (frame / this.run.rate).toFixed(1);
    this.slider.value = frame;
    this.slider.setAttribute("aria-valuetext", `frame ${frame * this.run.every} of ${this.last * this.run.every}, ${seconds} seconds`);
    if (this.reported !== frame)
      byName("clock").replaceChildren(element("span", `frame ${frame * this.run.every} · `, { className: "wide" }), `${seconds} s`);
    this.reported = frame;
    byName("play").setAttribute("aria-pressed", this.playing);
    byName("play").setAttribute("aria-label", this.playing ? "Pause" : "Play");
    this.changed();
  }
}
