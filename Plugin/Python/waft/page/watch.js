"use strict";
// SPDX-License-Identifier: BSD-3-Clause
// A page of `waft synthesize --watch`: it looks every second whether it was written anew, and then goes on where it was.

function watchPage(stamp, file) {
  const kept = "waft.watched";

  // The file beside the page calls this with the page's newest stamp.
  window.waftWritten = (newest) => {
    if (newest === stamp) return;
    const pressed = document.querySelector("#views [aria-pressed=true]");
    const { frame, playing } = window.waft;
    sessionStorage.setItem(kept, JSON.stringify({ frame, playing, view: pressed && pressed.dataset.view }));
    location.reload();
  };

  function look() {
    const script = element("script", "", { src: `${file}?${Date.now()}` });
    script.onload = script.onerror = () => script.remove();
    document.body.append(script);
  }

  const beginning = setInterval(() => {
    if (!window.waft || !window.waft.ready) return;
    clearInterval(beginning);
    const state = JSON.parse(sessionStorage.getItem(kept) || "null");
    sessionStorage.removeItem(kept);
    if (state) {
      if (state.view) window.waft.view(state.view);
      window.waft.seek(state.frame);
      if (state.playing) window.waft.play(); else window.waft.pause();
    }
    setInterval(look, 1000);
  }, 50);
}
