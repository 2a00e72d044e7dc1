"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// Where objects were wanted: a ring where one is to lie, a ball where one is to pass, a line for a path that was given.

const WAITING = 0xaab2b8;
const STATUS_COLORS = { met: 0x2aa57f, infeasible: 0xd6453a, conflict: 0xd97a26, unreachable: 0x9a6bd8 };

function linear(color) {
  return new THREE.Color(color).convertSRGBToLinear();
}

function statusColor(status) {
  return linear(STATUS_COLORS[status] || 0x888888);
}

class Marks {
  constructor(stage, run, objects, flyers) {
    this.run = run;
    this.group = new THREE.Group();
    this.spots = [];  // {mark, frame, place}: what can be pointed at
    const byId = new Map(objects.map((object) => [object.id, object]));
    const kinds = new Map();
    const extent = Math.max(...flyers.extents);
    const add = (key, status, spot) => {
      if (!kinds.has(`${key} ${status}`)) kinds.set(`${key} ${status}`, { key, status, spots: [] });
      kinds.get(`${key} ${status}`).spots.push(spot);
    };
    for (const mark of run.marks) {
      if (mark.places.length > 2 && mark.kind === "position") this.addLine(mark);
      mark.places.forEach(([frame, x, y, z, radius], number) => {
        const spot = { mark, frame, place: onStage([x, y, z]), radius };
        const object = byId.get(mark.object);
        if (mark.kind === "rest" && object) spot.place.y = object.positions[3 * frame + 1];
        if (number === 0 || mark.places.length <= 2) {
          this.spots.push(spot);
          add(mark.kind === "rest" ? "ring" : "ball", mark.status, spot);
          if (mark.kind !== "rest" && radius > 0.3 * extent) add("room", mark.status, spot);
        }
      });
    }
    const flat = new THREE.RingBufferGeometry(0.93, 1, 64).rotateX(-Math.PI / 2);
    const ball = new THREE.SphereBufferGeometry(1, 24, 16);
    const times = [...kinds.values()].flatMap((kind) => [{ ...kind, waits: true }, { ...kind, waits: false }]);
    this.meshes = times.map(({ key, status, spots, waits }) => {
      const material = new THREE.MeshBasicMaterial({ color: waits ? linear(WAITING) : statusColor(status), transparent: true,
        depthWrite: false, toneMapped: false,
        depthTest: status === "met",  // one that was missed may be within an obstacle
        opacity: { ring: 0.75, ball: 0.95, room: 0.14 }[key], side: THREE.DoubleSide });
      // A geometry of its own: three.js binds the places of instances anew only when the geometry is another.
      const mesh = new THREE.InstancedMesh((key === "ring" ? flat : ball).clone(), material, spots.length);
      mesh.frustumCulled = false;
      mesh.renderOrder = 1;
      this.group.add(mesh);
      const width = { ring: 0.5 * extent, ball: Math.min(0.12 * extent, 0.006 * stage.size) }[key];
      return { mesh, key, spots, width, waits };
    });
    stage.scene.add(this.group);
  }

  addLine(mark) {
    const points = mark.places.map(([, x, y, z]) => onStage([x, y, z]));
    const material = new THREE.LineBasicMaterial({ color: statusColor(mark.status), transparent: true, opacity: 0.8,
      toneMapped: false });
    this.group.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), material));
  }

  // A mark swells when its frame comes, and says from then on what became of it.
  moveTo(frame) {
    const matrix = new THREE.Matrix4(), turn = new THREE.Quaternion(), size = new THREE.Vector3();
    for (const { mesh, key, spots, width, waits } of this.meshes) {
      spots.forEach((spot, index) => {
        const away = (frame - spot.frame) / (0.2 * this.run.rate);
        const swell = key === "room" ? 1 : 1 + (key === "ball" ? 1.5 : 0.3) * Math.exp(-away * away);
        size.setScalar(frame < spot.frame === waits ? (width || spot.radius) * swell : 0);
        mesh.setMatrixAt(index, matrix.compose(spot.place, turn, size));
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
  }
}
