"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// Where one looks from: cameras fitted to what moves, orbiting by hand, following one object.

const VIEW_ANGLE = 28;  // degrees, of the picture's height
const MARGIN = 1.12;  // room round what must be seen
const smooth = (x) => { const t = Math.min(Math.max(x, 0), 1); return t * t * (3 - 2 * t); };
const mix = (a, b, part) => a + (b - a) * part;

// A place to look from: target, azimuth (0 looks along the scene's y), elevation (radians), distance.
function axesOf({ azimuth, elevation }) {
  const [s, c, u, v] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
  return { right: new THREE.Vector3(c, 0, -s), up: new THREE.Vector3(-s * u, v, -c * u), back: new THREE.Vector3(s * v, u, c * v) };
}

class Cameras {
  constructor(canvas, stage, flyers, run, changed) {
    Object.assign(this, { canvas, stage, flyers, run, changed });
    this.camera = new THREE.PerspectiveCamera(VIEW_ANGLE, 1, 0.02 * stage.size, 40 * stage.size);
    this.view = "auto";
    this.followed = -1;
    this.aspect = 1;
    this.reach = 0.5 * Math.max(...flyers.extents);
    this.floor = stage.center.y - 0.5 * (run.bounds[5] - run.bounds[4]);
    const ends = flyers.objects.map(({ positions }) => positions.subarray(3 * (run.frames - 1)));
    this.ends = ends.map((end) => new THREE.Vector3(...end));
    const resting = run.marks.filter(({ kind, places }) => kind === "rest" && places.length);
    this.lands = resting.length > 0.5 * flyers.objects.length;
    this.isCrowd = flyers.objects.length > 3;
    this.landing = resting.length ? Math.min(...resting.map(({ places }) => places[0][0])) : run.frames;
    this.fits = {};
    this.pose = null;
    this.listen();
  }

  resize(aspect) {
    if (Math.abs(aspect - this.aspect) < 1e-3) return;
    this.aspect = aspect;
    this.fits = {};
    if (this.view !== "free") this.pose = null;
  }

  places(frames) {
    const points = [];
    for (const { positions } of this.flyers.objects)
      for (const k of frames) points.push(new THREE.Vector3(positions[3 * k], positions[3 * k + 1], positions[3 * k + 2]));
    return points;
  }

  fit(points, azimuth, elevation, least = 0) {
    const { right, up, back } = axesOf({ azimuth, elevation });
    const axes = [right, up, back];
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const seen = points.map((point) => axes.map((axis, i) => {
      const value = point.dot(axis);
      low[i] = Math.min(low[i], value - this.reach);
      high[i] = Math.max(high[i], value + this.reach);
      return value;
    }));
    const center = low.map((value, i) => 0.5 * (value + high[i]));
    const half = Math.tan(VIEW_ANGLE * Math.PI / 360);
    let distance = least;
    for (const [x, y, z] of seen) {
      const wide = Math.max((Math.abs(x - center[0]) + this.reach) / (half * this.aspect), (Math.abs(y - center[1]) + this.reach) / half);
      distance = Math.max(distance, wide * MARGIN + z - center[2]);
    }
    const target = new THREE.Vector3();
    axes.forEach((axis, i) => target.addScaledVector(axis, center[i]));
    return { target, azimuth, elevation, distance };
  }

  wanted(frame) {
    if (this.followed >= 0) return this.following(frame);
    if (this.view === "auto") return this.auto(frame);
    this.fits[this.view] = this.fits[this.view] || (this.view === "top" ? this.top() : this.side());
    return this.fits[this.view];
  }

  side() {
    const frames = [...Array(Math.ceil(this.run.frames / 5)).keys()].map((k) => 5 * k);
    const points = this.places(frames);
    for (const point of this.places([0, this.run.frames - 1])) points.push(point.setY(this.floor));
    return this.fit(points, -0.2, 0.16);
  }

  top() {
    const points = [...this.ends];
    for (const { places } of this.run.marks) for (const [, x, y, z] of places) points.push(onStage([x, y, z]));
    return this.fit(points, 0, Math.PI / 2, 0.8 * this.stage.size);
  }

  // Near what flies, from low down, rising over what has come to lie.
  auto(frame) {
    const { loops, rate, frames: all } = this.run, half = Math.max(Math.round(rate / 2), 1);
    const count = loops ? Math.max(Math.round(all / half), 1) : Math.ceil((all - 1) / half) + 1;
    const step = loops ? all / count : half;
    if (!this.fits.auto) {
      const rough = [...Array(count).keys()].map((key) => {
        const at = Math.min(key * step, all - 1);
        const frames = [-2, -1, 0, 1, 2].map((k) => loops ? Math.floor((at + k * step + 2 * all) % all) : Math.min(Math.max(at + k * step, 0), all - 1));
        const turned = loops ? 0.25 - 0.25 * Math.cos(2 * Math.PI * at / all) : 0.5 * at / all;
        const rise = this.lands ? smooth((at - this.landing + 3.5 * this.run.rate) / (4.5 * this.run.rate)) : 0;
        const elevation = mix(0.2, this.isCrowd ? 1.2 : 0.6, rise), azimuth = mix(-0.42, 0, this.lands ? smooth(at / this.landing) : turned);
        const places = this.places(frames).concat(this.lands && this.isCrowd ? this.ends : []);
        return this.fit(places, azimuth, elevation, Math.max(9 * this.reach, this.isCrowd ? 0.45 * this.stage.size : 0) / Math.min(this.aspect, 1));
      });
      this.fits.auto = rough.map((_, key) => rough.reduce((sum, pose, other) => {
        const away = key - other - (loops ? count * Math.round((key - other) / count) : 0);
        const weight = Math.exp(-0.5 * (away / 1.5) ** 2), weights = sum.weight + weight;
        sum.target.lerp(pose.target, weight / weights);
        for (const name of ["azimuth", "elevation", "distance"]) sum[name] = mix(sum[name], pose[name], weight / weights);
        return Object.assign(sum, { weight: weights });
      }, { target: new THREE.Vector3(), azimuth: 0, elevation: 0, distance: 0, weight: 0 }));
    }
    const key = loops ? frame / step : Math.min(frame / step, count - 1), first = Math.floor(key), part = smooth(key - first);
    const [a, b] = [first, first + 1].map((number) => this.fits.auto[loops ? number % count : Math.min(number, count - 1)]);
    return { target: a.target.clone().lerp(b.target, part), azimuth: mix(a.azimuth, b.azimuth, part),
      elevation: mix(a.elevation, b.elevation, part), distance: mix(a.distance, b.distance, part) };
  }

  following() {
    const target = this.flyers.at[this.followed].clone();
    const { azimuth, elevation } = this.pose || { azimuth: -0.4, elevation: 0.2 };
    const extent = this.flyers.extents[this.flyers.objects[this.followed].shape];
    const distance = this.near || Math.max(11 * extent, 0.12 * this.stage.size);
    return { target, azimuth, elevation: Math.min(elevation, 1.3), distance };
  }

  choose(view) {
    this.view = view;
    this.followed = -1;
    this.near = 0;
    this.changed();
  }

  follow(index) {
    this.followed = index;
    this.near = 0;
    if (index < 0 && this.view === "free") this.view = "auto";
    this.changed();
  }

  // Moves on towards what is wanted; returns whether it has not arrived. seconds: since the last time; Infinity: at once.
  update(frame, seconds) {
    if (this.view === "free" && this.followed < 0) return this.apply(false);
    const wanted = this.wanted(frame);
    if (!this.pose) this.pose = { ...wanted, target: wanted.target.clone() };
    const part = this.view === "auto" && this.followed < 0 && this.settled ? 1 : 1 - Math.exp(-7 * seconds);
    const { pose } = this;
    const turn = Math.PI * 2, around = wanted.azimuth + turn * Math.round((pose.azimuth - wanted.azimuth) / turn);
    const left = pose.target.distanceTo(wanted.target) / pose.distance + Math.abs(pose.azimuth - around) +
      Math.abs(pose.elevation - wanted.elevation) + Math.abs(pose.distance / wanted.distance - 1);
    pose.target.lerp(wanted.target, this.followed >= 0 ? Math.min(1, 2 * part) : part);
    pose.azimuth = mix(pose.azimuth, around, part);
    pose.elevation = mix(pose.elevation, wanted.elevation, part);
    pose.distance = mix(pose.distance, wanted.distance, part);
    this.settled = left < 0.02;
    return this.apply(left > 1e-3);
  }

  apply(moves) {
    const { target, distance } = this.pose;
    const { up, back } = axesOf(this.pose);
    this.camera.aspect = this.aspect;
    this.camera.updateProjectionMatrix();
    this.camera.position.copy(target).addScaledVector(back, distance);
    if (this.pose.elevation > 0) this.camera.position.y = Math.max(this.camera.position.y, this.floor + 0.01 * this.stage.size);
    this.camera.up.copy(up);
    this.camera.lookAt(target);
    this.camera.updateMatrixWorld();
    return moves;
  }

  free() {
    if (this.followed < 0) this.view = "free";
    this.changed();
  }

  turn(dx, dy) {
    this.pose.azimuth -= 0.006 * dx;
    this.pose.elevation = Math.min(Math.max(this.pose.elevation + 0.006 * dy, -0.02), Math.PI / 2);
    this.free();
  }

  zoom(factor) {
    this.pose.distance = Math.min(Math.max(this.pose.distance * factor, 0.06 * this.stage.size), 12 * this.stage.size);
    this.near = this.pose.distance;
    this.free();
  }

  shift(dx, dy) {
    const { right, up } = axesOf(this.pose);
    const scale = 2 * Math.tan(VIEW_ANGLE * Math.PI / 360) * this.pose.distance / this.canvas.clientHeight;
    this.pose.target.addScaledVector(right, -dx * scale).addScaledVector(up, dy * scale);
    this.followed = -1;
    this.free();
  }

  listen() {
    const fingers = new Map();
    const spread = () => { const [a, b] = [...fingers.values()]; return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, gap: Math.hypot(a.x - b.x, a.y - b.y) }; };
    this.canvas.addEventListener("pointerdown", (event) => {
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      this.canvas.setPointerCapture(event.pointerId);
      this.dragged = fingers.size > 1 ? 99 : 0;
    });
    this.canvas.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const pair = fingers.size === 2 ? spread() : null;
      const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
      this.dragged += Math.hypot(dx, dy);
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (pair) {
        const now = spread();
        this.shift(now.x - pair.x, now.y - pair.y);
        this.zoom(pair.gap / Math.max(now.gap, 1));
      } else if (this.dragged > 4) {
        if (event.buttons & 2 || event.shiftKey) this.shift(dx, dy); else this.turn(dx, dy);
      }
    });
    for (const name of ["pointerup", "pointercancel"])
      this.canvas.addEventListener(name, (event) => {
        const isClick = name === "pointerup" && fingers.size === 1 && this.dragged <= 4;
        fingers.delete(event.pointerId);
        if (isClick && this.clicked) this.clicked(event.clientX, event.clientY);
      });
    this.canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(0.0012 * event.deltaY));
    }, { passive: false });
  }
}
