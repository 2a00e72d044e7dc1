"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// Brings it all together. `window.waft` is for those who put the page into another one.

function begin() {
  const run = JSON.parse(byName("run").textContent);
  origin = run.origin;
  const animation = bytesOfBase64(byName("animation").textContent);
  const glb = new Glb(animation);
  const shapes = glb.shapes(), objects = glb.objects();
  run.loops = objects.some(({ loopTo }) => loopTo !== undefined);
  tellFacts(run, objects, shapes);

  const canvas = byName("canvas");
  const stage = new Stage(canvas, run);
  const flyers = new Flyers(stage, shapes, objects, run);
  const marks = new Marks(stage, run, objects, flyers);
  const flown = new Paths(stage, objects.map(({ positions }) => positions), run.frames, run.rate, run.loops);
  const plan = run.plan && planned(run.plan, objects.length, run.frames);
  const intended = plan && new Paths(stage, plan, run.frames, run.rate, false);
  let stale = true;
  const changed = () => { stale = true; };
  const cameras = new Cameras(canvas, stage, flyers, run, () => { changed(); showView(); });
  const player = new Player(run, changed);
  const picture = new Picture({ stage, flyers, marks, flown, plan, intended, cameras });

  const ids = new Map(objects.map(({ id }, index) => [id, index]));
  const names = new Map(objects.map(({ id, name }) => [id, name]));
  const speeds = speedPlot(run, objects, (frame) => player.seek(frame));
  const plots = [speeds, run.energy && energyPlot(run.energy), run.rounds.length ? roundsPlot(run.rounds) : null];
  byName("plots").append(...plots.filter(Boolean).map(({ root }) => root));
  if (run.measured) reportMeasured(run.measured);
  reportMarks(run, names, (mark) => {
    player.seek(mark.shown);
    if (ids.has(mark.object)) follow(ids.get(mark.object));
    report(mark);
  });
  drawTicks(byName("ticks"), run);
  byName("save").href = URL.createObjectURL(new Blob([animation], { type: "model/gltf-binary" }));

  let noted = 0;
  function note(text) {
    byName("note").textContent = text;
    clearTimeout(noted);
    noted = setTimeout(() => { byName("note").textContent = ""; }, 5000);
  }
  function report(mark) {
    const who = names.get(mark.object) || "no object";
    note(`${who}, frame ${mark.frame}: ${constraintText(mark, run.every)}: ${mark.status}` + (mark.message ? ` (${mark.message})` : ""));
  }

  function follow(index) {
    cameras.follow(index);
    byName("follow").value = index < 0 ? "" : index;
    speeds.follow(index);
    for (const paths of [flown, intended]) if (paths) paths.set({ picked: index });
    changed();
  }
  function look(view) {
    follow(-1);
    cameras.choose(view);
  }
  function showView() {
    for (const button of document.querySelectorAll("#views [data-view]"))
      button.setAttribute("aria-pressed", cameras.followed < 0 && button.dataset.view === cameras.view);
  }

  byName("follow").append(...objects.map(({ name }, index) => element("option", name, { value: index })));
  byName("follow").addEventListener("change", ({ target }) => follow(target.value === "" ? -1 : Number(target.value)));
  for (const button of document.querySelectorAll("#views [data-view]"))
    button.addEventListener("click", () => look(button.dataset.view));
  byName("full").addEventListener("click", fill);
  byName("full").hidden = !byName("theatre").requestFullscreen;
  function fill() {
    if (document.fullscreenElement) document.exitFullscreen(); else if (!byName("full").hidden) byName("theatre").requestFullscreen();
  }
  const switches = { paths: "p", marks: "m", obstacles: "o", beside: "b" };
  for (const name of Object.keys(switches)) byName(name).addEventListener("change", changed);
  byName("beside").disabled = !plan;
  byName("obstacles").parentElement.hidden = !stage.obstacles.children.length;

  function dress(name) {
    byName("scheme").value = byName("theatre").dataset.stage = name;
    const colors = stage.dress(name);
    for (const paths of [flown, intended]) if (paths) paths.set({ color: new THREE.Color(colors.path) });
    changed();
  }
  const dark = matchMedia("(prefers-color-scheme: dark)");
  let isPale = false;
  const dressBySystem = () => dress(dark.matches ? "night" : isPale ? "dusk" : "paper");
  byName("scheme").addEventListener("change", ({ target }) => dress(target.value));
  dark.addEventListener("change", dressBySystem);

  // What is nearest to a click: an object, or else a mark.
  function nearest(x, y, spots, reach) {
    const box = canvas.getBoundingClientRect();
    let best = -1, least = reach;
    spots.forEach((spot, index) => {
      const [u, v] = picture.project(spot);
      const away = Math.hypot(u + box.left - x, v + box.top - y);
      if (away < least) [best, least] = [index, away];
    });
    return best;
  }
  cameras.clicked = (x, y) => {
    flyers.moveTo(player.frame);
    const object = nearest(x, y, flyers.at, 26);
    const spot = object < 0 && byName("marks").checked ? nearest(x, y, marks.spots.map(({ place }) => place), 18) : -1;
    if (spot >= 0) return report(marks.spots[spot].mark);
    if (object >= 0) note(`following ${objects[object].name}`);
    follow(object);
  };
  const keys = {
    " ": () => player.toggle(), Home: () => player.seek(0), End: () => player.seek(player.last), Escape: () => look("auto"),
    a: () => look("auto"), s: () => look("side"), t: () => look("top"), f: fill,
    ArrowLeft: (event) => player.step(event.shiftKey ? -Math.round(run.rate) : -1),
    ArrowRight: (event) => player.step(event.shiftKey ? Math.round(run.rate) : 1),
  };
  for (const [name, key] of Object.entries(switches)) keys[key] = () => byName(name).click();
  addEventListener("keydown", (event) => {
    const isTyped = event.target.closest("select, a, summary, .scroll") || (event.key === " " && event.target.closest("button, [type=checkbox]"));
    const act = keys[event.key.length > 1 ? event.key : event.key.toLowerCase()];
    if (!act || isTyped || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act(event);
  });

  function draw(seconds) {
    speeds.mark(Math.round(player.frame));
    return picture.draw(player.frame, seconds);
  }

  let before = performance.now();
  function tick(now) {
    const seconds = Math.min(Math.max(now - before, 0) / 1000, 0.25);  // a first picture may be of before
    before = now;
    player.advance(seconds);
    if (stale) {
      stale = false;
      if (draw(seconds)) stale = true;
    }
    requestAnimationFrame(tick);
  }
  new ResizeObserver(changed).observe(canvas);

  dressBySystem();
  flyers.pictures.then((brightnesses) => {
    isPale = objects.reduce((sum, { shape }) => sum + brightnesses[shape], 0) > 0.62 * objects.length;
    dressBySystem();
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) player.toggle(true);
    window.waft.ready = true;
  });
  window.waft = {
    ready: false, run,
    get frame() { return player.frame; },
    get playing() { return player.playing; },
    seek: (frame) => player.seek(frame),
    play: () => player.toggle(true),
    pause: () => player.toggle(false),
    view: (name) => look(name),
    follow: (id) => follow(ids.has(id) ? ids.get(id) : -1),
    stage: (name) => dress(name),
    // Draws at once, the camera where it is to come to; for pictures.
    settle: () => { draw(Infinity); draw(Infinity); },
    // Pixels of the canvas at which a point of the scene (z up) is seen.
    project: (point) => picture.project(onStage(point)),
  };
  requestAnimationFrame(tick);
}

// Positions of the plan, of all objects: 16 bits in its box.
function planned({ low, high, steps }, count, frames) {
  const values = numbers(Uint16Array, steps);
  return [...Array(count).keys()].map((object) => {
    const path = new Float32Array(3 * frames);
    for (let k = 0; k < frames; k++) {
      const place = [0, 1, 2].map((axis) => low[axis] + (high[axis] - low[axis]) * values[3 * (object * frames + k) + axis] / 65535);
      path.set(onStage(place).toArray(), 3 * k);
    }
    return path;
  });
}

function lack(text) {
  const notice = element("p", text, { className: "lack" });
  notice.setAttribute("role", "alert");
  byName("stage").append(notice);
}

try {
  begin();
} catch (error) {
  lack(error.message);
  console.error(error);
}
