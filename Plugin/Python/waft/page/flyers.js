"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// What flies: one instanced mesh a shape; leaves let light through, films shine at their rims.

// Light that falls on the far side of a leaf comes through it, warmer.
const TRANSLUCENT = `#include <lights_fragment_end>
  float through = saturate(dot(-geometry.normal, directionalLights[0].direction));
  reflectedLight.directDiffuse += 0.55 * through * directionalLights[0].color * diffuseColor.rgb * vec3(1.1, 1.0, 0.72);`;

// A coarser level of the picture has a smoother outline.
const OUTLINE = `#if defined(USE_MAP) && defined(ALPHATEST)
    diffuseColor.a = texture2D(map, vUv, 1.3).a + 0.08;
  #endif
  #include <alphatest_fragment>
  diffuseColor.a = 1.0;`;

const FILM = `float facing = saturate(dot(normalize(vViewPosition), normal));
  float rim = pow(1.0 - facing, 2.2);
  vec3 sheen = 0.5 + 0.5 * cos(6.2832 * (vec3(0.0, 0.33, 0.67) + 1.4 * facing + 0.35 * normal.y));
  float glint = pow(saturate(dot(normal, normalize(vec3(-0.4, 0.75, 0.5)))), 90.0) + 0.5 * pow(saturate(dot(normal, normalize(vec3(0.45, -0.6, 0.5)))), 60.0);
  gl_FragColor = vec4(mix(vec3(1.0), sheen, 0.45) * (0.75 + 0.25 * rim) + glint, saturate(0.06 + 0.75 * rim + glint));`;

class Flyers {
  // rate: frames a second; loops: after the last frame each goes on as another one.
  constructor(stage, shapes, objects, { frames, rate, loops }) {
    Object.assign(this, { objects, frames, rate, loops });
    const placeOf = new Map(objects.map(({ id }, index) => [id, index]));
    this.goesOn = objects.map(({ loopTo }, index) => placeOf.has(loopTo) ? placeOf.get(loopTo) : index);
    this.extents = shapes.map(({ geometry }) => Math.max(...geometry.boundingBox.getSize(new THREE.Vector3()).toArray()));
    this.group = new THREE.Group();
    this.meshes = shapes.map((shape, number) => {
      const own = objects.filter(({ shape: of }) => of === number);
      own.forEach((object, place) => { object.place = place; });
      const mesh = new THREE.InstancedMesh(shape.geometry, shape.isFilm ? this.film() : this.leaf(shape), own.length);
      mesh.frustumCulled = false;
      mesh.castShadow = !shape.isFilm;
      mesh.receiveShadow = !shape.isFilm;
      if (shape.isFilm) mesh.renderOrder = 3;
      mesh.customDepthMaterial = new THREE.MeshDepthMaterial({ depthPacking: THREE.RGBADepthPacking, map: mesh.material.map,
        alphaTest: mesh.material.alphaTest, side: THREE.DoubleSide });
      this.group.add(mesh);
      return mesh;
    });
    stage.scene.add(this.group);
    this.pictures = Promise.all(shapes.map((shape, number) => this.load(shape, this.meshes[number])));
    this.at = objects.map(() => new THREE.Vector3());
  }

  leaf({ color, picture }) {
    const material = new THREE.MeshStandardMaterial({ roughness: 0.88, metalness: 0, side: THREE.DoubleSide });
    material.color.setRGB(...color);
    if (picture) {
      material.map = new THREE.Texture();
      Object.assign(material.map, { flipY: false, encoding: THREE.sRGBEncoding, anisotropy: 8 });
      material.alphaTest = 0.5;
    }
    material.onBeforeCompile = (shader) => {
      shader.fragmentShader = shader.fragmentShader.replace("#include <lights_fragment_end>", TRANSLUCENT)
        .replace("#include <alphatest_fragment>", OUTLINE);
    };
    return material;
  }

  film() {
    const material = new THREE.MeshStandardMaterial({ roughness: 0.1, transparent: true, depthWrite: false });
    material.onBeforeCompile = (shader) => {
      shader.fragmentShader = shader.fragmentShader.replace("gl_FragColor = vec4( outgoingLight, diffuseColor.a );", FILM);
    };
    return material;
  }

  // Resolves to how bright the shape is, from 0 to 1.
  load({ picture, color, isFilm }, mesh) {
    if (!picture) return Promise.resolve(isFilm ? 1 : Math.sqrt(Math.max(...color.slice(0, 3))));
    return new Promise((resolve) => {
      const image = new Image();
      image.onload = () => {
        mesh.material.map.image = image;
        mesh.material.map.needsUpdate = true;
        resolve(brightness(image));
      };
      image.onerror = () => {  // its plain colour, then
        mesh.material.map = mesh.customDepthMaterial.map = null;
        mesh.material.alphaTest = mesh.customDepthMaterial.alphaTest = 0;
        mesh.material.needsUpdate = mesh.customDepthMaterial.needsUpdate = true;
        resolve(0.5);
      };
      image.src = picture;
    });
  }

  // paths: what gives other positions than those of the animation; the turning is the animation's in any case.
  moveTo(frame, paths) {
    const first = Math.min(Math.floor(frame), this.frames - 1), isLast = first + 1 === this.frames;
    const next = !isLast ? first + 1 : this.loops ? 0 : first;
    const part = frame - first;
    const turn = new THREE.Quaternion(), later = new THREE.Quaternion(), matrix = new THREE.Matrix4();
    const size = new THREE.Vector3();
    this.objects.forEach((object, index) => {
      const after = isLast && this.loops ? this.goesOn[index] : index;
      const [positions, then] = [index, after].map((number) => paths ? paths[number] : this.objects[number].positions);
      const place = this.at[index];
      for (let axis = 0; axis < 3; axis++)
        place.setComponent(axis, positions[3 * first + axis] * (1 - part) + then[3 * next + axis] * part);
      const seen = this.sizeAt(object, frame);
      size.set(seen, seen, seen);
      turn.fromArray(object.rotations, 4 * first).slerp(later.fromArray(this.objects[after].rotations, 4 * next), part);
      this.meshes[object.shape].setMatrixAt(object.place, matrix.compose(place, turn, size));
    });
    for (const mesh of this.meshes) mesh.instanceMatrix.needsUpdate = true;
  }

  // 0 where it is not in the shot.
  sizeAt({ times, sizes }, frame) {
    if (!times) return 1;
    const seconds = frame / this.rate + 1e-6;
    let key = 0;
    while (key + 1 < times.length && times[key + 1] <= seconds) key++;
    return sizes[3 * key];
  }
}

function brightness(image) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 32;
  const pen = canvas.getContext("2d");
  pen.drawImage(image, 0, 0, 32, 32);
  const { data } = pen.getImageData(0, 0, 32, 32);
  let sum = 0, weight = 1e-9;
  for (let i = 0; i < data.length; i += 4) {
    sum += data[i + 3] * (0.3 * data[i] + 0.59 * data[i + 1] + 0.11 * data[i + 2]);
    weight += data[i + 3];
  }
  return sum / weight / 255;
}
