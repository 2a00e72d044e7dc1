"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// Reads animation.glb as Waft writes it: a mesh and a material a shape, a node an object with keys at every frame; one above
// them says where a scene far from its origin stands.

function bytesOfBase64(text) {
  const letters = atob(text.trim());
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

const GLB_ARRAYS = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const GLB_WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

class Glb {
  constructor(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const length = view.getUint32(12, true);
    this.json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
    this.data = bytes.subarray(28 + length, 28 + length + view.getUint32(20 + length, true));
  }

  accessor(index) {
    const { bufferView, byteOffset = 0, componentType, count, type } = this.json.accessors[index];
    const { byteOffset: first = 0 } = this.json.bufferViews[bufferView];
    const kind = GLB_ARRAYS[componentType];
    const start = this.data.byteOffset + first + byteOffset;
    const values = count * GLB_WIDTHS[type];
    return new kind(this.data.buffer.slice(start, start + values * kind.BYTES_PER_ELEMENT));
  }

  // A picture as an address that needs no network.
  picture(index) {
    const { bufferView, mimeType } = this.json.images[index];
    const { byteOffset = 0, byteLength } = this.json.bufferViews[bufferView];
    let letters = "";
    for (let at = byteOffset; at < byteOffset + byteLength; at += 8192)
      letters += String.fromCharCode(...this.data.subarray(at, Math.min(at + 8192, byteOffset + byteLength)));
    return `data:${mimeType};base64,${btoa(letters)}`;
  }

  // One entry a mesh: its geometry and what its material says.
  shapes() {
    return this.json.meshes.map(({ name, primitives: [{ attributes, indices, material }] }) => {
      const geometry = new THREE.BufferGeometry();
      const add = (label, index, width) => index !== undefined &&
        geometry.setAttribute(label, new THREE.BufferAttribute(this.accessor(index), width));
      add("position", attributes.POSITION, 3);
      add("normal", attributes.NORMAL, 3);
      add("uv", attributes.TEXCOORD_0, 2);
      if (indices !== undefined) geometry.setIndex(new THREE.BufferAttribute(this.accessor(indices), 1));
      if (attributes.NORMAL === undefined) geometry.computeVertexNormals();
      geometry.computeBoundingBox();
      const { pbrMetallicRoughness: look = {}, alphaMode } = this.json.materials[material] || {};
      const texture = look.baseColorTexture && this.json.textures[look.baseColorTexture.index];
      return { name, geometry, color: look.baseColorFactor || [1, 1, 1, 1], isFilm: alphaMode === "BLEND",
        picture: texture ? this.picture(texture.source) : null };
    });
  }

  // One entry an object: its shape, in a loop as whom it begins anew, positions and quaternions (x, y, z, w) of all frames, and where it
  // is not seen at all of them the times [s] from which it is seen or not, with its size.
  objects() {
    const keys = this.json.nodes.map(() => ({}));
    const { channels, samplers } = this.json.animations[0];
    for (const { sampler, target } of channels) {
      keys[target.node][target.path] = this.accessor(samplers[sampler].output);
      if (target.path === "scale") keys[target.node].times = this.accessor(samplers[sampler].input);
    }
    return this.json.nodes.flatMap(({ name, mesh, extras }, index) => extras ? [{ name, id: extras.ObjectId, loopTo: extras.LoopTo, shape: mesh,
      positions: keys[index].translation, rotations: keys[index].rotation, times: keys[index].times,
      sizes: keys[index].scale }] : []);
  }
}
