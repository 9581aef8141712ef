#include "eval/detail/drive_player.hpp"

#include "eval/detail/text.hpp"

namespace sketchloc::detail {
namespace {

constexpr std::string_view kControls = R"html(
<p class="controls"><button id="play" type="button">Play</button>
<label>Speed <select id="speed"><option value="1">1x</option><option value="4"
selected="selected">4x</option><option value="16">16x</option></select></label>
<label><input id="near" type="checkbox"/> Near the robot</label>
<input id="moment" type="range" min="0" value="0" aria-label="Moment of the drive"/></p>
<p id="state" class="state"></p>
<div class="player">
<figure><figcaption>The drawing, as the robot believes</figcaption>
<canvas id="drawing"></canvas></figure>
<figure><figcaption>The building, as it is</figcaption><canvas id="world"></canvas></figure></div>
<p class="legend"><span style="color:#00785a"><i class="dot"></i>robot, its way so far, 95 % ellipse
of its position</span><span style="color:#0064be"><i class="dash"></i>planned way</span>
<span style="color:#0064be"><i class="square"></i>goal</span><span style="color:#c22f6e"><i
class="dot"></i>where it takes the goal to be</span><span style="color:#d07000"><i
class="dot"></i>what the scan saw</span><span style="color:#777"><i class="square"></i>where it truly
is (in the drawing)</span><span style="color:#c8a878"><i class="area"></i>furniture</span></p>
)html";

/// Places of a frame: `s` pose in the drawing (px, rad, px/m), `w` in the world (m, rad), `t` the
/// true place in the drawing, `g` the believed goal and `e` end points in the robot's metres.
constexpr std::string_view kView = R"js(
const drive = JSON.parse(document.getElementById("drive").textContent);
const byId = id => document.getElementById(id);
const isKnown = numbers => numbers === null ? false : numbers.every(n => n !== null);

/* A canvas over a picture, all of it or `across` px around a middle; places are px, y up. */
class View {
  constructor(id, picture, size) {
    this.canvas = byId(id);
    this.picture = byId(picture);
    this.size = size;
  }
  clear(middle, across) {
    const width = Math.round(this.canvas.clientWidth * (window.devicePixelRatio || 1));
    const height = Math.round(width * this.size[1] / this.size[0]);
    const isNear = across ? isKnown(middle) : false;
    this.canvas.width = width;
    this.canvas.height = height;
    this.zoom = width / (isNear ? across : this.size[0]);
    this.low = isNear ? [middle[0] - width / this.zoom / 2, middle[1] - height / this.zoom / 2]
                      : [0, 0];
    this.pen = this.canvas.getContext("2d");
    this.pen.imageSmoothingEnabled = 2 > this.zoom;
    this.pen.drawImage(this.picture, ...this.at(0, this.size[1]),
                       this.zoom * this.size[0], this.zoom * this.size[1]);
    this.unit = width / 450;
  }
  at(x, y) {
    return [this.zoom * (x - this.low[0]), this.canvas.height - this.zoom * (y - this.low[1])];
  }
  line(points, colour, width, dash) {
    this.pen.beginPath();
    points.filter(isKnown).forEach(p => this.pen.lineTo(...this.at(...p)));
    this.pen.strokeStyle = colour;
    this.pen.lineWidth = width * this.unit;
    this.pen.setLineDash(dash ? [5 * this.unit, 4 * this.unit] : []);
    this.pen.stroke();
  }
  dots(points, colour, radius) {
    this.pen.fillStyle = colour;
    points.filter(isKnown).forEach(p => {
      this.pen.beginPath();
      this.pen.arc(...this.at(...p), radius * this.unit, 0, 2 * Math.PI);
      this.pen.fill();
    });
  }
  ring(place, radius, colour) {
    if (!isKnown(place)) return;
    const round = Array.from({length: 33}, (_, i) => [
      place[0] + radius * Math.cos(i * Math.PI / 16), place[1] + radius * Math.sin(i * Math.PI / 16)]);
    this.line(round, colour, 2);
  }
  /* (xx, xy, yy) of a Gaussian: the ellipse that holds 95 % of it, by its Cholesky factor. */
  ellipse(place, covariance, colour) {
    if (!isKnown(covariance) || covariance[0] === 0) return;
    const [xx, xy, yy] = covariance;
    const a = Math.sqrt(xx), b = xy / a, c = Math.sqrt(Math.max(0, yy - b * b));
    this.line(Array.from({length: 49}, (_, i) => {
      const u = 2.448 * Math.cos(i * Math.PI / 24), v = 2.448 * Math.sin(i * Math.PI / 24);
      return [place[0] + a * u, place[1] + b * u + c * v];
    }), colour, 1.5);
  }
  robot(pose, radius, colour) {
    this.dots([pose.slice(0, 2)], colour, Math.max(3, radius * this.zoom / this.unit));
    const ahead = 2 * Math.max(radius, 3 * this.unit / this.zoom);
    this.line([pose.slice(0, 2), [pose[0] + ahead * Math.cos(pose[2]),
                                  pose[1] + ahead * Math.sin(pose[2])]], colour, 2.5);
  }
}

/* Takes the robot's metres to a view, for a pose there and a scale in px/m. */
const placed = (pose, scale) => ([x, y]) => {
  const c = scale * Math.cos(pose[2]), s = scale * Math.sin(pose[2]);
  return [pose[0] + c * x - s * y, pose[1] + s * x + c * y];
};
)js";

constexpr std::string_view kPlay = R"js(
const green = "#00785a", blue = "#0064be", orange = "#d07000", pink = "#c22f6e";
const inDrawing = new View("drawing", "drawing-picture", drive.drawing_px);
const inWorld = new View("world", "world-picture", drive.world_cells);
const inCells = pose => [(pose[0] - drive.origin_m[0]) / drive.cell_m,
                         (pose[1] - drive.origin_m[1]) / drive.cell_m, pose[2]];
const nearMetres = () => byId("near").checked ? 10 : 0;
let now = 0;

function showDrawing(frame) {
  inDrawing.clear(frame.s.slice(0, 2), nearMetres() * frame.s[3]);
  inDrawing.line(drive.paths_px[frame.path], blue, 2, true);
  inDrawing.line(drive.frames.slice(0, now + 1).map(f => f.s.slice(0, 2)), green, 2);
  inDrawing.ring(drive.goal_px, drive.success_m * (frame.s[3] || 0), blue);
  inDrawing.ring(frame.t, drive.radius_m * (frame.s[3] || 0), "#777");
  if (!isKnown(frame.s)) return;
  inDrawing.dots(frame.e.map(placed(frame.s, frame.s[3])), orange, 1.2);
  inDrawing.ellipse(frame.s, frame.c, green);
  inDrawing.robot(frame.s, drive.radius_m * frame.s[3], green);
}

function showWorld(frame) {
  const pose = inCells(frame.w), scale = 1 / drive.cell_m, place = placed(pose, scale);
  inWorld.clear(pose.slice(0, 2), nearMetres() * scale);
  inWorld.line(drive.frames.slice(0, now + 1).map(f => inCells(f.w)), green, 2);
  inWorld.dots(frame.e.map(place), orange, 1.2);
  inWorld.ring(inCells(drive.goal_m), drive.success_m * scale, blue);
  inWorld.robot(pose, drive.radius_m * scale, green);
  if (isKnown(frame.g)) inWorld.dots([place(frame.g)], pink, 3.5);
}

function show(index) {
  now = Math.max(0, Math.min(drive.frames.length - 1, index));
  const frame = drive.frames[now];
  showDrawing(frame);
  showWorld(frame);
  const seconds = i => (i * drive.cycle_s).toFixed(1);
  const off = isKnown(frame.s) ? Math.hypot(frame.s[0] - frame.t[0], frame.s[1] - frame.t[1]) /
    frame.s[3] : NaN;
  byId("moment").value = now;
  byId("state").textContent = `${seconds(now)} s of ${seconds(drive.frames.length - 1)} s: ` +
    `${drive.doings[frame.doing]}${frame.hit ? ", bumps into something" : ""}. ` +
    `Localized with probability ${frame.p === null ? "unknown" : frame.p.toFixed(2)}; in truth ` +
    `${isFinite(off) ? off.toFixed(2) + " m" : "unknown"} off in the drawing.`;
}

let timer = null;
function pause() {
  clearInterval(timer);
  timer = null;
  byId("play").textContent = "Play";
}
function play() {
  if (now === drive.frames.length - 1) show(0);
  byId("play").textContent = "Pause";
  timer = setInterval(() => {
    show(now + 1);
    if (now === drive.frames.length - 1) pause();
  }, 1000 * drive.cycle_s / Number(byId("speed").value));
}
function start() {
  byId("player").hidden = false;
  byId("moment").max = drive.frames.length - 1;
  byId("moment").addEventListener("input", () => { pause(); show(Number(byId("moment").value)); });
  byId("near").addEventListener("change", () => show(now));
  byId("play").addEventListener("click", () => timer === null ? play() : pause());
  byId("speed").addEventListener("change", () => { if (timer !== null) { pause(); play(); } });
  window.addEventListener("resize", () => show(now));
  const moment = /^#t=([0-9.]+)$/.exec(location.hash);  /* report.html#t=12.5 opens there */
  show(moment === null ? 0 : Math.round(Number(moment[1]) / drive.cycle_s));
}
window.addEventListener("load", () => { if (drive.frames.length !== 0) start(); });
)js";

std::string hidden_picture(std::string_view id, std::string_view png) {
  return "<img hidden=\"hidden\" alt=\"\" id=\"" + std::string(id) +
         "\" src=\"data:image/png;base64," + base64(png) + "\"/>";
}

}  // namespace

std::string drive_player(std::string_view drive_json, std::string_view drawing_png,
                         std::string_view world_png) {
  std::string html = "<section id=\"player\" hidden=\"hidden\"><h2>The drive, scan by scan</h2>";
  html += kControls;
  html += hidden_picture("drawing-picture", drawing_png);
  html += hidden_picture("world-picture", world_png);
  html += "</section><script id=\"drive\" type=\"application/json\">";
  html += drive_json;
  html += "</script><script>";  // has no < and no ampersand: the page is XML too
  html += kView;
  html += kPlay;
  return html + "</script>";
}

}  // namespace sketchloc::detail
