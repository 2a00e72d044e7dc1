"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// What does not fly: light, ground, obstacles; and how colours depend on the chosen stage.

// What is drawn is relative to it, as keys are: numbers of 32 bits are exact there, however far the scene is from its own origin.
let origin = [0, 0, 0];

// glTF and three.js have y up, scenes z up.
const yUp = ([x, y, z]) => new THREE.Vector3(x, z, -y);
const onStage = (place) => yUp(place.map((value, axis) => value - origin[axis]));

// shade and glow: colour and strength of shadows on the ground, and of the light round its middle.
const STAGES = {
  paper: { obstacle: 0xc4bbab, sky: 0xfff6e8, bounce: 0xcdbfa8, ambient: 0.55, sun: 0.95, path: 0x4a4438,
    shade: [0x4a3f33, 0.42], glow: [0xfffaf0, 0.35] },
  dusk: { obstacle: 0x8da2b2, sky: 0xdcebf6, bounce: 0x7d8a94, ambient: 0.5, sun: 1.0, path: 0xffffff,
    shade: [0x16222e, 0.5], glow: [0xb5cad8, 0.28] },
  night: { obstacle: 0x5d6571, sky: 0xc4d2e6, bounce: 0x55524f, ambient: 0.45, sun: 1.05, path: 0xe8edf4,
    shade: [0x040506, 0.66], glow: [0x6d7686, 0.34] },
};

function numbers(kind, text) {
  return new kind(bytesOfBase64(text).buffer);
}

// A surface that is smooth but where its faces meet at more than 40 degrees; points are relative to the origin, z up.
function creased(points, triangles) {
  const places = Array.from({ length: points.length / 3 }, (_, k) => yUp(points.subarray(3 * k, 3 * k + 3)));
  const normals = [], around = new Map();
  const keyOf = (corner) => places[corner].toArray().map((value) => value.toFixed(5)).join();
  const keys = places.map((_, corner) => keyOf(corner));
  for (let face = 0; face < triangles.length / 3; face++) {
    const [a, b, c] = [...triangles.subarray(3 * face, 3 * face + 3)];
    normals.push(places[b].clone().sub(places[a]).cross(places[c].clone().sub(places[a])));  // as long as the face is large
    for (const corner of [a, b, c]) {
      if (!around.has(keys[corner])) around.set(keys[corner], []);
      around.get(keys[corner]).push(face);
    }
  }
  const position = new Float32Array(3 * triangles.length), normal = new Float32Array(3 * triangles.length);
  triangles.forEach((corner, at) => {
    const own = normals[Math.floor(at / 3)], sum = new THREE.Vector3();
    for (const face of around.get(keys[corner])) if (own.angleTo(normals[face]) < 0.7) sum.add(normals[face]);
    places[corner].toArray(position, 3 * at);
    sum.normalize().toArray(normal, 3 * at);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
  return geometry;
}

class Stage {
  constructor(canvas, run) {
    this.run = run;
    const [x0, x1, y0, y1, z0, z1] = run.bounds;
    this.size = Math.max(x1 - x0, y1 - y0);
    this.center = onStage([(x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2]);
    const settings = { antialias: true, alpha: true };
    const context = canvas.getContext("webgl2", settings) || canvas.getContext("webgl", settings);
    if (!context) throw new Error("This browser shows no 3-D pictures: WebGL is off.");
    this.renderer = new THREE.WebGLRenderer({ canvas, context, ...settings });
    this.renderer.gammaOutput = true;
    this.renderer.gammaFactor = 2.2;
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 1.15;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.scene = new THREE.Scene();
    this.addLight(z1 - z0);
    this.addObstacles();
  }

  addLight(height) {
    this.sky = new THREE.HemisphereLight(0xffffff, 0xffffff, 1);
    this.sun = new THREE.DirectionalLight(0xfff1dc, 1);
    const reach = 0.5 * Math.hypot(this.size, this.size, height);
    this.sun.target.position.copy(this.center);
    this.sun.position.copy(this.center).addScaledVector(new THREE.Vector3(-0.42, 0.86, 0.3).normalize(), 2 * reach);
    const { camera } = this.sun.shadow;
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: reach, far: 3.5 * reach });
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 1.6;
    this.sun.shadow.bias = -0.0009;
    this.rim = new THREE.DirectionalLight(0xcfe0ff, 0.25);
    this.rim.position.copy(this.center).add(new THREE.Vector3(3, 1.4, -4));
    this.rim.target.position.copy(this.center);
    this.scene.add(this.sky, this.sun, this.sun.target, this.rim, this.rim.target);
  }

  addObstacles() {
    this.obstacles = new THREE.Group();
    this.moving = [];
    this.solid = new THREE.MeshStandardMaterial({ roughness: 0.9, metalness: 0, side: THREE.DoubleSide,
      shadowSide: THREE.BackSide });
    for (const entry of this.run.obstacles) {
      if (entry.ground !== null) {
        this.addGround(entry.ground);
        continue;
      }
      const mesh = new THREE.Mesh(creased(numbers(Float32Array, entry.points), numbers(Uint32Array, entry.triangles)), this.solid);
      mesh.castShadow = mesh.receiveShadow = true;
      this.obstacles.add(mesh);
      if (entry.shifts) this.moving.push({ mesh, shifts: numbers(Float32Array, entry.shifts) });
    }
    this.scene.add(this.obstacles);
  }

  // A floor that shows only what falls on it: shadows, and light round its middle. The rest is the backdrop.
  addGround(height) {
    // Drawn before all else, so that bodies that lie a hair below it are not veiled.
    this.soil = new THREE.ShadowMaterial({ transparent: false, depthWrite: false, blending: THREE.CustomBlending,
      blendSrcAlpha: THREE.OneFactor, blendDstAlpha: THREE.OneMinusSrcAlphaFactor });
    this.floor = { middle: { value: this.center.clone() }, reach: { value: this.size },
      shade: { value: new THREE.Vector4() }, glow: { value: new THREE.Vector4() } };
    this.soil.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.floor);
      shader.vertexShader = "varying vec3 vPlace;\n" + shader.vertexShader.replace("#include <begin_vertex>",
        "#include <begin_vertex>\n  vPlace = (modelMatrix * vec4(position, 1.0)).xyz;");
      shader.fragmentShader = "varying vec3 vPlace;\nuniform vec3 middle;\nuniform float reach;\nuniform vec4 shade, glow;\n" +
        shader.fragmentShader.replace(/void main\(\) \{[^]*\}/, `void main() {
  float fall = 1.0 - smoothstep(0.0, 1.9 * reach, distance(vPlace.xz, middle.xz));
  float grain = fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453) - 0.5;  // against bands
  gl_FragColor = mix(shade, vec4(glow.rgb, glow.a * fall * fall + grain / 50.0), getShadowMask());
}`);
    };
    const floor = new THREE.Mesh(new THREE.CircleBufferGeometry(2 * this.size, 96), this.soil);
    floor.rotation.x = -Math.PI / 2;
    floor.position.set(this.center.x, height - origin[2] - 5e-4 * this.size, this.center.z);
    floor.receiveShadow = true;
    floor.renderOrder = -1;
    this.scene.add(floor);
  }

  moveTo(frame) {
    const last = this.run.frames - 1;
    const first = Math.min(Math.floor(frame), last), next = Math.min(first + 1, last), part = frame - first;
    for (const { mesh, shifts } of this.moving) {
      const at = (axis) => shifts[3 * first + axis] * (1 - part) + shifts[3 * next + axis] * part;
      mesh.position.copy(yUp([at(0), at(1), at(2)]));
    }
  }

  dress(name) {
    const colors = STAGES[name];
    this.sky.color.set(colors.sky);
    this.sky.groundColor.set(colors.bounce);
    this.sky.intensity = colors.ambient;
    this.sun.intensity = colors.sun;
    this.solid.color.set(colors.obstacle).convertSRGBToLinear();
    for (const name of this.floor ? ["shade", "glow"] : []) {
      const { r, g, b } = new THREE.Color(colors[name][0]);
      this.floor[name].value.set(r, g, b, colors[name][1]);
    }
    return colors;
  }
}
