// Where one looks, and from how near; and what a pointer, a wheel or two fingers do to that.

class Camera {
  constructor() {
    Object.assign(this, { x: 0, z: 0, scale: 40, width: 1, height: 1, wanted: null });
  }

  /** The whole of a box [x0, x1, z0, z1] with a margin. */
  fit([x0, x1, z0, z1]) {
    [this.x, this.z] = [(x0 + x1) / 2, (z0 + z1) / 2];
    const size = (low, high) => Math.max(high - low, 1e-6);
    this.scale = 0.92 * Math.min(this.width / size(x0, x1), this.height / size(z0, z1));
    this.wanted = [x0, x1, z0, z1]; // until there is room
  }

  resize(width, height) {
    if (width < 1 || height < 1) return; // hidden
    const [before, now] = [Math.min(this.width, this.height), Math.min(width, height)];
    [this.width, this.height] = [width, height];
    if (before > 1) this.scale *= now / before; // what was in view stays in view
    else if (this.wanted) this.fit(this.wanted);
  }

  toScreen(x, z) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (z - this.z) * this.scale];
  }

  toWorld(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.z - (py - this.height / 2) / this.scale];
  }

  /** Nearer by a factor; the point under (px, py) stays there. */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, z] = this.toWorld(px, py);
    this.scale = clamp(this.scale * factor, 1e-6, 1e9);
    const [nx, nz] = this.toWorld(px, py);
    this.x += x - nx;
    this.z += z - nz;
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.z += dy / this.scale;
  }
}

/** Lets pointers move a camera; `moved("pan" | "zoom")` is told, and `tapped(px, py)` of a click or a tap. */
function steer(canvas, camera, { moved, tapped }) {
  const down = new Map();
  let travelled = 0;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const spread = () => {
    const [[ax, ay], [bx, by]] = [...down.values()];
    return { size: Math.max(Math.hypot(ax - bx, ay - by), 1), x: (ax + bx) / 2, y: (ay + by) / 2 };
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    if (down.size === 0) travelled = 0;
    down.set(event.pointerId, place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!down.has(event.pointerId)) return;
    const [px, py] = down.get(event.pointerId);
    const here = place(event);
    travelled += Math.hypot(here[0] - px, here[1] - py);
    if (down.size === 2) {
      const before = spread();
      down.set(event.pointerId, here);
      const after = spread();
      camera.pan(after.x - before.x, after.y - before.y);
      camera.zoom(after.size / before.size, after.x, after.y);
      moved("zoom");
    } else {
      down.set(event.pointerId, here);
      if (travelled > 4) {
        camera.pan(here[0] - px, here[1] - py);
        moved("pan");
      }
    }
  });
  const up = (event) => {
    if (down.delete(event.pointerId) && down.size === 0 && travelled <= 4 && event.type === "pointerup") {
      tapped(...place(event));
    }
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      camera.zoom(Math.exp(-clamp(event.deltaY * lines, -120, 120) * 0.0025), ...place(event));
      moved("zoom");
    },
    { passive: false },
  );
}
