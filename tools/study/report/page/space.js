// A frame in three dimensions: what the recording tells of it, taken back from the frame that pictures are drawn in to
// base, for Scene3D.

const kWallShown_m = 15, kFloorShown_m = 6;  // of a plane ahead, behind and aside, beyond what was measured

class SpaceView {
  constructor(viewer) {
    Object.assign(this, { viewer, recording: viewer.recording, cloud: undefined, sweep: null });
    this.scene = new Scene3D(document.getElementById('space'), { on_change: () => this.say() });
    for (const button of document.querySelectorAll('#space-looks button')) {
      button.addEventListener('click', () => this.scene.look_from(button.dataset.look));
    }
    this.say();
  }

  // In place of the view where there is none, or what a finger does.
  say() {
    const w = words(), fault = this.scene && this.scene.fault;
    document.getElementById('space-panel').classList.toggle('without', Boolean(fault));
    document.getElementById('space').classList.toggle('awake', Boolean(this.scene && this.scene.is_awake));
    document.getElementById('space-note').textContent = fault ? w.space_faults[fault] : w.space_help;
  }

  show(frame) {
    this.say();
    if (this.scene.fault) return;
    const { viewer, recording: r } = this;
    Object.assign(this, { frame, into_base: this.placer(frame) });
    this.show_cloud(r.cloud_at(frame));
    this.scene.set_old(viewer.is_old);
    this.scene.set_planes(viewer.planes_shown ? this.planes() : []);
    this.scene.set_region(viewer.planes_shown ? this.regions() : []);
    this.scene.set_boxes(viewer.boxes_shown ? r.head.body_boxes : []);
    this.scene.set_machine(viewer.planes_shown ? this.machine() : null);
    this.scene.set_sweep(this.sweep);
  }

  // A place as it is drawn in a frame, in base.
  placer(frame) {
    const { forward, left } = this.recording.head.machine, { origin, ahead, aside, up } = this.recording.axes_of(frame);
    return (p) => {
      let f = 0, l = 0, z = 0;
      for (let i = 0; i < 3; ++i) {
        const off = p[i] - origin[i];
        f += off * ahead[i]; l += off * aside[i]; z += off * up[i];
      }
      return [f * forward[0] + l * left[0], f * forward[1] + l * left[1], z];
    };
  }

  show_cloud(cloud) {
    const r = this.recording, { shown } = this.viewer;
    if (cloud < 0) return this.scene.set_cloud(new Float32Array(0), new Uint8Array(0), shown);
    const [from, to] = r.cloud_range(cloud), xyz = new Float32Array(3 * (to - from)), into_base = this.placer(r.frame_of_cloud(cloud));
    for (let k = from; k < to; ++k) xyz.set(into_base([r.point_cm[3 * k] / 100, r.point_cm[3 * k + 1] / 100, r.point_cm[3 * k + 2] / 100]), 3 * (k - from));
    return this.scene.set_cloud(xyz, r.point_label.subarray(from, to), shown);
  }

  // Corners of a wall from and to places along the road, above the floor as high as walls are looked for.
  wall_corners(side, from, to) {
    const [, along, left, up, d] = this.viewer.wall(side), low = this.viewer.floor_up(), { wall_z_min, wall_z_max } = this.recording.head;
    const at = (a, h) => this.into_base([a, -(d + along * a + up * h) / left, h]);
    const [bottom, top] = [low + Math.min(0, wall_z_min), low + wall_z_max];
    return [at(from, bottom), at(to, bottom), at(to, top), at(from, top)];
  }

  has_wall(side) { return this.viewer.wall(side)[0] > 0; }
  wall_tint(side) { return side ? 'right' : 'left'; }

  planes() {
    const out = [0, 1].filter((side) => this.has_wall(side)).map((side) => ({
      corners: this.wall_corners(side, -kWallShown_m, kWallShown_m), tint: this.wall_tint(side), is_pale: true }));
    if (this.recording.floor[3 * this.frame] > 0) {
      const up = this.viewer.floor_up(), x = kWallShown_m, y = kFloorShown_m;
      out.push({ corners: [[-x, -y], [x, -y], [x, y], [-x, y]].map((p) => this.into_base([...p, up])), tint: 'floor', grid_m: 1 });
    }
    return out;
  }

  regions() {
    return [0, 1].filter((side) => this.has_wall(side)).map((side) => {
      const [, , , , , from, to] = this.viewer.wall(side);
      return { corners: this.wall_corners(side, from, to), tint: this.wall_tint(side) };
    });
  }

  machine() {
    const { viewer } = this, at = (k) => this.into_base(viewer.machine_point(k)), [x, y] = this.recording.head.machine.forward;
    return { corners: [0, 1, 2, 3].map(at), ahead: [x, y, 0], sensor: at(4), lines: [0, 1, 2, 3].map((k) => this.distance(k)).filter(Boolean) };
  }

  // As in the views from above and in section: solid is raw, dashed is the value, grey is not valid.
  distance(k) {
    const r = this.recording, i = r.at(this.frame, 3 + k), side = k < 2 ? 0 : 1, start = this.viewer.machine_point(5 + k);
    if (!Number.isFinite(r.value[i]) || r.state[i] === INVALID) return null;
    const has_raw = Number.isFinite(r.raw[i]), end = this.viewer.foot_of(start, side, has_raw ? r.raw[i] : r.value[i]);
    return { from: this.into_base(start), to: this.into_base(end), tint: r.state[i] === VALID ? 'valid' : 'not-valid', is_dashed: !has_raw };
  }
}
