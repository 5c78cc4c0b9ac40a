// The page: puts its parts together.

import "uplot/dist/uPlot.min.css";
import "./viewer.css";
import { App, nowS, type Views } from "./app.ts";
import type { Quantity } from "./colours.ts";
import type { ConnectionState } from "./connection.ts";
import { Controls } from "./controls.ts";
import { DevicesPanel } from "./devices_panel.ts";
import { download, fileStamp, find, remember, remembered, write } from "./dom.ts";
import { caption } from "./figure.ts";
import { FrameMarks } from "./frame_marks.ts";
import { HandPanel } from "./hand_panel.ts";
import { HISTORY_S } from "./history.ts";
import { install } from "./hook.ts";
import { Legend } from "./legend.ts";
import { LookPanel } from "./look_panel.ts";
import { NodesPanel } from "./nodes_panel.ts";
import { Notices } from "./notices.ts";
import { ParametersPanel } from "./parameters_panel.ts";
import { Plots } from "./plots.ts";
import { Stage } from "./stage.ts";
import { csv } from "./table.ts";
import { colour, Theme } from "./theme.ts";
import { Timeline } from "./timeline.ts";

const QUANTITIES: readonly Quantity[] = ["displacement", "force", "stiffness"];

function start(): void {
  const notices = new Notices(find("notices"));
  const quantity = QUANTITIES.find((one) => one === remembered("quantity")) ?? "displacement";
  const look = new LookPanel(find("look"), (choices) => stage.setLook(choices));
  const stage = new Stage(find<HTMLCanvasElement>("picture"), {
    ...look.choices,
    quantity,
    fullScaleM: 0.005,
    forceScaleMPerN: 0.02,
    displacementScale: 1,
    probeRadiusM: 0.005,
  });

  const devices = new DevicesPanel(find("devices"));
  const nodes = new NodesPanel(find("nodes"));
  const parameters = new ParametersPanel(find("parameters"), (name, value) => app.setParameter(name, value));
  const plots = new Plots(find("plots"), () => app.recorder.minute.series, (agoS) => timeline.set(agoS));
  const marks = new FrameMarks(find("frame"));
  const timeline = new Timeline(find("timeline"), (agoS) => {
    app.lookBack(agoS);
    plots.mark(agoS);
    find("stage").classList.toggle("looking-back", agoS > 0);
  });

  const views: Views = {
    hello(hello) {
      devices.setDevices(hello.devices);
      plots.setDevices(hello.devices);
      marks.setFrame(hello.body_frame);
      showScene(app);
    },
    chains: () => showScene(app),
    connection: showConnection,
    state: (state) => devices.update(state.devices),
    status(status) {
      nodes.update(status);
      devices.setStatus(status.devices);
      handPanel.setDevices(status.devices.filter((one) => one.pointer).map((one) => one.name));
    },
    parameters: (list) => parameters.update(list),
    result: (result) => parameters.onResult(result),
    lost() {
      parameters.onLost();
      devices.setStatus([]);
    },
    body() {
      find("waiting").hidden = true;
      find("stage").classList.remove("bodiless");
      showScene(app);
    },
    hand: () => handPanel?.show(),
    live: () => timeline.set(0),
    recorded({ endS, history }) {
      plots.update(endS);
      timeline.setReach(endS - (history.oldestS ?? endS));
    },
  };
  const app = new App(stage, notices, views);
  const handPanel = new HandPanel(find("hand"), app.hand, () => {});

  const legend = new Legend(find("legend"), quantity, choose);
  stage.onScale = (scale) => legend.show(scale);
  function choose(chosen: Quantity): void {
    remember("quantity", chosen);
    legend.choose(chosen);
    stage.setLook({ quantity: chosen });
  }

  const showMarks = stage.onPicture;
  stage.onPicture = () => {
    showMarks?.();
    marks.update(stage.orbit);
  };
  new Controls(stage.canvas, stage.orbit, app.hand, {
    tool: () => (find("hand").hidden ? "look" : handPanel.tool),
    chooseColour: (index) => choose(QUANTITIES[index]),
    toggleChains: () => look.toggleChains(),
    lookBack: (byS) => timeline.step(byS),
    live: () => timeline.set(0),
    help: () => find<HTMLDialogElement>("keys").showModal(),
  });

  const page = find("stage");
  new ResizeObserver(() => stage.resize(page.clientWidth, page.clientHeight)).observe(page);
  new Theme(find("theme"), () => {
    stage.setBackground(colour("stage"));
    plots.rebuild();
    devices.recolour();
  });
  wireButtons(app, stage);
  setInterval(() => showCounters(app), 500);
  install(app);
}

function wireButtons(app: App, stage: Stage): void {
  const on = (id: string, action: () => void): void => find(id).addEventListener("click", action);
  on("zoom-in", () => stage.orbit.zoom(0.8));
  on("zoom-out", () => stage.orbit.zoom(1.25));
  on("reset", () => stage.orbit.reset());
  on("help", () => find<HTMLDialogElement>("keys").showModal());
  on("png", () => {
    const draw = (context: CanvasRenderingContext2D, widthPx: number, heightPx: number): void => {
      const { scale, orbit } = stage;
      const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
      if (scale) caption(context, widthPx, heightPx, rem, { scale, orbit, frame: app.hello?.body_frame ?? "" });
    };
    stage.png(2, draw).then(
      (blob) => download(blob, `rhombus-${fileStamp(new Date())}.png`),
      (error: unknown) => app.notices.set("png", String(error), 6000),
    );
  });
  on("csv", () => {
    const { minute, devices, serverColumn } = app.recorder;
    const text = csv(minute.series, devices, minute.endS - HISTORY_S, minute.endS, serverColumn);
    download(new Blob([text], { type: "text/csv" }), `rhombus-${fileStamp(new Date())}.csv`);
  });
  const toggle = find("panel-toggle");
  const show = (open: boolean): void => {
    document.body.classList.toggle("panel-closed", !open);
    toggle.setAttribute("aria-expanded", String(open));
    find("panel").inert = !open;
  };
  show(remembered("panel") !== "closed");
  on("panel-toggle", () => {
    const open = toggle.getAttribute("aria-expanded") !== "true";
    remember("panel", open ? "open" : "closed");
    show(open);
  });
}

/** What is loaded: the frame everything stands in, the body and its law. */
function showScene({ hello, body, chains }: App): void {
  if (!hello) return;
  const parts = [hello.scene_frame];
  if (hello.namespace !== "/" && hello.namespace !== "") parts.push(hello.namespace);
  if (body) parts.push(`${body.vertexCount.toLocaleString("en").replaceAll(",", "\u202f")} vertices`);
  const count = chains?.chains.length ?? 0;
  if (chains && count > 0) parts.push(`${count} ${count === 1 ? "chain" : "chains"}, ${chains.formulation} law`);
  write(find("session"), parts.join(" · "));
}

function showConnection(state: ConnectionState): void {
  const pill = find("connection");
  const texts = {
    connecting: "Connecting",
    connected: "Connected",
    silent: "Connected, but the node is silent",
    waiting: state.phase === "waiting" && state.full ? `No room: ${state.reason}` : "Connection lost, trying again",
  };
  // Attempts are not read aloud one by one, and what a refused page reads does not flicker.
  if (state.phase === "connecting" && state.attempt > 1) return;
  pill.dataset.phase = state.phase;
  write(pill, texts[state.phase]);
  pill.title = state.phase === "waiting" ? state.reason : "";
  write(find("waiting").children[0], state.phase === "waiting" && state.full ? `No room for this page: ${state.reason}. It tries again now and then.` : "Waiting for the body");
}

let last = { applied: 0, bytes: 0, atS: 0 };

function showCounters(app: App): void {
  const { counts } = app.inbox;
  const [atS, applied, bytes] = [nowS(), app.applied, counts.bytes];
  const seconds = atS - last.atS;
  const rate = (applied - last.applied) / seconds;
  const kilobytes = (bytes - last.bytes) / seconds / 1000;
  last = { applied, bytes, atS };
  const body = app.body ? `${app.body.vertexCount} vertices, ${app.body.movedCount} moved` : "no body";
  const notDrawn = Object.values(app.status?.not_drawn ?? {}).reduce((sum, count) => sum + count, 0);
  const parts = [
    `${body}.`,
    `${rate.toFixed(0)} updates/s, ${kilobytes.toFixed(0)} kB/s;`,
    `${applied} applied of ${counts.surfaces},`,
    `${app.state?.dropped ?? 0} dropped by the node, ${counts.missing} missing,`,
    `${counts.garbage} garbage, ${counts.outOfOrder} out of order, ${app.otherMesh} of another mesh,`,
    `${counts.notFinite + (app.body?.notFinite ?? 0)} not finite,`,
    `${notDrawn} not drawn by the node.`,
  ];
  const trip = app.connection.counts.roundTripMs;
  if (Number.isFinite(trip)) parts.push(`Round trip ${trip.toFixed(1)} ms.`);
  write(find("counters"), parts.join(" "));
}

try {
  start();
} catch (error) {
  const text = document.createElement("p");
  text.textContent = `This browser cannot show the picture (WebGL 2 is needed): ${String(error)}`;
  document.getElementById("waiting")?.replaceChildren(text);
}
