"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// The ways that objects take, as ribbons of equal width on the screen: the last second fading, or all of them.

const RIBBON_VERTEX = `
attribute vec4 start, end;  // place, and frame + object * frames
uniform float frames, frame, trail, whole, picked, width, loops;
uniform vec2 pixels;
varying float strength;
void main() {
  float object = floor((start.w + 0.5) / frames);
  float first = start.w - object * frames;
  float along = position.x;
  float now = frame + (loops > 0.5 && frame < trail && first > frame ? frames : 0.0);
  if (whole < 0.5) along = min(along, now - first);
  float age = now - first - along;
  bool isPicked = abs(object - picked) < 0.5;
  bool shown = first < frames - 1.5 && (whole > 0.5 || isPicked || (along > 0.0 || position.x < 0.5) && now > first && age <= trail);
  float fading = max(0.0, 1.0 - abs(age) / trail);
  strength = whole > 0.5 ? 0.22 + (age >= 0.0 ? 0.5 * fading : 0.0) : age < 0.0 ? 0.0 : 0.5 * fading * fading;
  if (isPicked) strength = max(strength, age > 0.0 ? 0.9 : 0.4);
  if (picked >= 0.0 && !isPicked) strength *= 0.35;
  vec4 a = projectionMatrix * modelViewMatrix * vec4(start.xyz, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(end.xyz, 1.0);
  vec4 here = mix(a, b, clamp(along, 0.0, 1.0));
  vec2 way = (b.xy / b.w - a.xy / a.w) * pixels;
  way = length(way) > 1e-6 ? normalize(way) : vec2(1.0, 0.0);
  here.xy += vec2(-way.y, way.x) * position.y * width * (isPicked ? 1.6 : 1.0) / pixels * here.w;
  gl_Position = shown && a.w > 0.0 && b.w > 0.0 ? here : vec4(2.0, 2.0, 2.0, 1.0);
}`;
const RIBBON_FRAGMENT = `
uniform vec3 color;
varying float strength;
void main() {
  if (strength < 0.01) discard;
  gl_FragColor = vec4(color, strength);
}`;

class Paths {
  // loops: the last frame leads on to the first.
  constructor(stage, paths, frames, rate, loops) {
    const values = new Float32Array(4 * paths.length * frames);
    paths.forEach((path, object) => {
      for (let k = 0, at = 4 * object * frames; k < frames; k++, at += 4) {
        values.set(path.subarray(3 * k, 3 * k + 3), at);
        values[at + 3] = k + object * frames;
      }
    });
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    // A piece starts at one entry and ends at the next.
    const buffer = new THREE.InstancedInterleavedBuffer(values, 4, 1);
    geometry.setAttribute("start", new THREE.InterleavedBufferAttribute(buffer, 4, 0));
    geometry.setAttribute("end", new THREE.InterleavedBufferAttribute(buffer, 4, 4));
    geometry.maxInstancedCount = paths.length * frames - 1;
    const crowd = Math.min(1, Math.sqrt(60 / paths.length));
    this.material = new THREE.ShaderMaterial({ vertexShader: RIBBON_VERTEX, fragmentShader: RIBBON_FRAGMENT, transparent: true,
      depthWrite: false, side: THREE.DoubleSide, uniforms: {
        frames: { value: frames }, frame: { value: 0 }, trail: { value: Math.max(crowd * rate, 1) }, whole: { value: 0 },
        loops: { value: loops ? 1 : 0 }, picked: { value: -1 }, width: { value: 1 }, pixels: { value: new THREE.Vector2(1, 1) },
        color: { value: new THREE.Color(0xffffff) } } });
    this.mesh = new THREE.Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 2;
    stage.scene.add(this.mesh);
  }

  set(values) {
    for (const [name, value] of Object.entries(values)) this.material.uniforms[name].value = value;
  }
}
