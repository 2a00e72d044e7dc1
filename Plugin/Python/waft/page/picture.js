"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// The picture of a frame: one pane with the result, or the plan and the result, by the same camera.

class Picture {
  constructor(parts) {
    Object.assign(this, parts, { canvas: parts.stage.renderer.domElement });
  }

  // The panes as [x, y from below, width, height], the result last.
  layout() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!byName("beside").checked) return { width, height, panes: [[0, 0, width, height]] };
    const isWide = width > height;
    return { width, height, panes: isWide ? [[0, 0, width / 2, height], [width / 2, 0, width / 2, height]]
      : [[0, height / 2, width, height / 2], [0, 0, width, height / 2]] };
  }

  // A place on the stage as pixels of the canvas, in the pane of the result.
  project(place) {
    const { height, panes } = this.layout();
    const [x, y, w, h] = panes[panes.length - 1];
    const seen = place.clone().project(this.cameras.camera);
    return [x + (0.5 + 0.5 * seen.x) * w, height - y - h + (0.5 - 0.5 * seen.y) * h];
  }

  // Returns whether the camera has not arrived yet. seconds: since the last time.
  draw(frame, seconds) {
    const { stage, flyers, marks, flown, intended, cameras } = this;
    const { width, height, panes } = this.layout();
    const [, , w, h] = panes[0];
    this.fit(width, height);
    for (const name of ["label-plan", "label-result"]) byName(name).hidden = panes.length < 2;
    stage.moveTo(frame);
    stage.obstacles.visible = byName("obstacles").checked;
    marks.moveTo(frame);
    marks.group.visible = byName("marks").checked;
    for (const paths of [flown, intended])
      if (paths) paths.set({ frame, whole: byName("paths").checked ? 1 : 0, width: w < 600 ? 0.7 : 0.9, pixels: new THREE.Vector2(w / 2, h / 2) });
    flyers.moveTo(frame);
    cameras.resize(w / h);
    const moves = cameras.update(frame, seconds);
    stage.renderer.setScissorTest(panes.length > 1);
    panes.forEach((pane, index) => this.drawPane(pane, frame, panes.length > 1 && index === 0));
    return moves;
  }

  fit(width, height) {
    const { renderer } = this.stage;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    if (renderer.getPixelRatio() !== ratio) renderer.setPixelRatio(ratio);
    const size = renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) renderer.setSize(width, height, false);
  }

  drawPane(pane, frame, isPlan) {
    const { stage, flyers, flown, intended, plan, cameras } = this;
    flyers.moveTo(frame, isPlan ? plan : null);
    flown.mesh.visible = !isPlan;
    if (intended) intended.mesh.visible = isPlan;
    stage.renderer.setViewport(...pane);
    stage.renderer.setScissor(...pane);
    stage.renderer.render(stage.scene, cameras.camera);
  }
}
