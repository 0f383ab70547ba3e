#!/usr/bin/env node
// Draws the pictures of the worked examples, docs/images/NAME.png from tests/cases/NAME, with the program's own page.
import { execFileSync } from 'node:child_process';
import { accessSync, appendFileSync, constants, cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { delimiter, dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { deflateSync } from 'node:zlib';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const cases = join(root, 'tests', 'cases');

const width = 1400; // of a file, pixels
const usual = [840, 600]; // of the page's picture: 12 pixels of the page, the height of letters, are then 20 of the file
const oversampling = 2; // drawn so many times larger, then reduced: smooth edges

const usage = `Usage: docs/draw_gallery.mjs [NAME…] [OPTIONS]

Draws docs/images/NAME.png from tests/cases/NAME: the program cuts or runs the model and writes its page,
which a browser without a screen opens and saves as a picture. NAME…: these cases; default: all that have
a picture.json.

Options:
  --rockfold PROGRAM     default: build/release/rockfold
  --chromium PROGRAM     default: chromium, chromium-browser or google-chrome of the PATH
  --out FOLDER           for the pictures; default: docs/images
  -h, --help             this text

It needs Node.js 18, Chromium and the package playwright-core, looked for in the folder NODE_PATH, then in
build/release/web-test/node_modules, where the tests of the page put it (ctest -L page).

picture.json beside a model says how it is drawn, or is a list of such pictures:

    command      "cut", "support" or "run"
    arguments    ["--set", …]: more arguments for the program
    add          ["[[solid]]", …]: lines that the model gets for the picture
    address      "field=batch&camera=…": what follows # in the page's address when it shows the view (docs/page.md)
    hide         [rule, …]: blocks that are left out. A rule holds for blocks that have all that it names:
                   "stages": [0, …]        excavated at one of these; 0: it stays
                   "batches": [0, …]       a key block of one of these; 0: it is none
                   "over": m3              larger than this
                   "beyond": [{"point": [x, y, z], "normal": [x, y, z]}, …]
                                           its centroid is beyond all of these planes
    ghost        [rule, …]: blocks that are seen through
    materials    {"granite": "#cc7766", …}: their colours, instead of the page's
    size         [width, height] of the page's picture, in its pixels; default: [${usual.join(', ')}]
    image        name of the picture, instead of the case's

A file is ${width} pixels wide and has at most 256 colours.`;

class Failure extends Error {}

function program(name, wanted) {
  const found = (wanted ? [resolve(wanted)] : ['chromium', 'chromium-browser', 'google-chrome'].flatMap((word) =>
    (process.env.PATH ?? '').split(delimiter).map((folder) => join(folder, word)))).find((path) => {
    try {
      accessSync(path, constants.X_OK);
      return true;
    } catch {
      return false;
    }
  });
  if (!found) throw new Failure(`${name} was not found${wanted ? `: ${wanted}` : ''}`);
  return found;
}

function playwright() {
  const folders = [...(process.env.NODE_PATH ?? '').split(delimiter).filter(Boolean), join(root, 'build', 'release', 'web-test', 'node_modules')];
  for (const folder of folders)
    if (existsSync(join(folder, 'playwright-core'))) return createRequire(join(resolve(folder), 'x.js'))('playwright-core').chromium;
  throw new Failure(`playwright-core is in none of ${folders.join(', ')}: ctest -L page puts it there, or NODE_PATH=FOLDER names another folder`);
}

const known = ['command', 'arguments', 'add', 'address', 'hide', 'ghost', 'materials', 'size', 'image'];
const ofRules = ['stages', 'batches', 'over', 'beyond'];

function readPictures(name) {
  const file = join(cases, name, 'picture.json');
  if (!existsSync(file)) throw new Failure(`${name}: there is no ${file}`);
  let read;
  try {
    read = JSON.parse(readFileSync(file, 'utf8'));
  } catch (error) {
    throw new Failure(`${file}: ${error.message}`);
  }
  const pictures = [read].flat();
  for (const picture of pictures) checkPicture(file, picture);
  return pictures;
}

function checkPicture(file, picture) {
  const wrong = Object.keys(picture).find((key) => !known.includes(key));
  if (wrong) throw new Failure(`${file}: "${wrong}" is none of ${known.join(', ')}`);
  for (const rule of [...(picture.hide ?? []), ...(picture.ghost ?? [])])
    for (const key of Object.keys(rule))
      if (!ofRules.includes(key)) throw new Failure(`${file}: "${key}" of a rule is none of ${ofRules.join(', ')}`);
  if (!['cut', 'support', 'run'].includes(picture.command)) throw new Failure(`${file}: "command" must be "cut", "support" or "run"`);
}

/// The page of a case's result, in `folder`.
function writePage(name, picture, rockfold, folder) {
  const place = join(folder, name);
  cpSync(join(cases, name), place, { recursive: true });
  const model = join(place, 'model.toml');
  appendFileSync(model, `\n${(picture.add ?? []).join('\n')}\n`);
  const [result, page] = [join(place, 'result.vtkhdf'), join(place, 'page.html')];
  for (const words of [[picture.command, model, '-o', result, '--force', '--quiet', ...(picture.arguments ?? [])], ['view', result, '-o', page, '--quiet']])
    try {
      execFileSync(rockfold, words, { cwd: place, stdio: 'pipe' });
    } catch (error) {
      throw new Failure(`${name}: rockfold ${words[0]}: ${String(error.stderr ?? error.message).trim()}`);
    }
  return page;
}

/// Runs in the page: what picture.json says beyond the address.
function dress(picture) {
  const app = window.rockfold;
  const { arrays } = app.data;
  const [stage, volume, centroid, batch] = [arrays.get('stage'), arrays.get('volume'), arrays.get('centroid'), arrays.find('batch')];
  const beyond = (b, { point, normal }) => normal.reduce((sum, n, d) => sum + n * (centroid[3 * b + d] - point[d]), 0) > 0;
  const holds = (b) => (rule) => (rule.stages ?? [stage[b]]).includes(stage[b]) && (rule.batches ?? [batch?.[b] ?? 0]).includes(batch?.[b] ?? 0)
    && volume[b] > (rule.over ?? -1) && (rule.beyond ?? []).every((plane) => beyond(b, plane));
  const blocks = (rules, wanted) => [...app.surface.blockId].filter((_, b) => rules.some(holds(b)) === wanted);
  if (picture.hide) app.store.set({ hidden: blocks(picture.hide, true) });
  if (picture.ghost) app.store.set({ show: 'chosen', rest: 'ghost', chosen: blocks(picture.ghost, false) });
  if (picture.materials)
    app.store.set({ paint: app.data.document.materials.map((name) => picture.materials[name]?.slice(1) ?? '').join('_') });
}

/// Runs in the page: its picture, `across` pixels wide, as RGBA in base64.
async function pixels({ across, ratio }) {
  const { scene } = window.rockfold;
  const { clientWidth, clientHeight } = scene.canvas;
  const down = Math.round((across * clientHeight) / clientWidth);
  const once = scene.draw.bind(scene);
  scene.draw = () => { // then the screen's would follow, which nobody sees
    scene.draw = () => {};
    once();
  };
  const small = await createImageBitmap(await window.rockfold.picture(ratio), { resizeWidth: across, resizeHeight: down, resizeQuality: 'high' });
  const paint = Object.assign(document.createElement('canvas'), { width: across, height: down }).getContext('2d');
  paint.drawImage(small, 0, 0);
  const reader = new FileReader();
  reader.readAsDataURL(new Blob([paint.getImageData(0, 0, across, down).data]));
  await new Promise((done) => { reader.onload = done; });
  return { down, rgba: reader.result.split(',')[1] };
}

async function draw(browser, page, picture) {
  const [across, down] = picture.size ?? usual;
  const ratio = (oversampling * width) / across;
  const context = await browser.newContext({ viewport: { width: across, height: down + 48 }, deviceScaleFactor: ratio, colorScheme: 'light', reducedMotion: 'reduce', offline: true });
  try {
    const tab = await context.newPage();
    tab.setDefaultTimeout(600_000);
    // Nothing is drawn for the screen: without a graphics card that takes seconds each time.
    await tab.addInitScript(() => { window.requestAnimationFrame = () => 0; });
    const polling = 50; // ms
    const faults = [];
    tab.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
    tab.on('pageerror', (error) => faults.push(error.message));
    await tab.goto(`${pathToFileURL(page)}#${picture.address ?? ''}`);
    await tab.waitForFunction(() => document.documentElement.dataset.ready, undefined, { polling });
    if ((await tab.evaluate(() => document.documentElement.dataset.ready)) !== 'yes') throw new Failure(`the page says: ${await tab.textContent('.failure')}`);
    const panels = await tab.evaluate(() => innerHeight - window.rockfold.scene.canvas.clientHeight); // header, and time where there are states
    await tab.setViewportSize({ width: across, height: down + panels });
    await tab.waitForFunction((aspect) => Math.abs(window.rockfold.scene.camera.aspect - aspect) < 1e-6, across / down, { polling });
    await tab.evaluate(dress, picture);
    const drawn = await tab.evaluate(pixels, { across: width, ratio });
    if (faults.length) throw new Failure(faults.join('\n'));
    return { down: drawn.down, rgba: Buffer.from(drawn.rgba, 'base64') };
  } finally {
    await context.close();
  }
}

/// At most `most` colours (each [r, g, b]) for those of a picture, and the number of one for each cell of 64³: the box of colours
/// with the largest sum of squares about its mean is split at the mean of its widest side, again and again.
function palette(rgba, most) {
  const cells = new Map();
  for (let i = 0; i < rgba.length; i += 4) {
    const key = ((rgba[i] >> 2) << 12) | ((rgba[i + 1] >> 2) << 6) | (rgba[i + 2] >> 2);
    let cell = cells.get(key);
    if (!cell) cells.set(key, (cell = { key, count: 0, sum: [0, 0, 0] }));
    ++cell.count;
    for (let d = 0; d < 3; ++d) cell.sum[d] += rgba[i + d];
  }
  for (const cell of cells.values()) cell.colour = cell.sum.map((s) => s / cell.count);
  const boxOf = (members) => {
    const count = members.reduce((n, c) => n + c.count, 0);
    const mean = [0, 1, 2].map((d) => members.reduce((s, c) => s + c.sum[d], 0) / count);
    const spread = [0, 1, 2].map((d) => members.reduce((s, c) => s + c.count * (c.colour[d] - mean[d]) ** 2, 0));
    return { members, mean, spread, error: members.length > 1 ? spread[0] + spread[1] + spread[2] : 0 };
  };
  const boxes = [boxOf([...cells.values()])];
  while (boxes.length < most) {
    const worst = boxes.reduce((best, box, i) => (box.error > boxes[best].error ? i : best), 0);
    const { members, mean, spread, error } = boxes[worst];
    if (error === 0) break;
    const d = spread.indexOf(Math.max(...spread));
    boxes.splice(worst, 1, boxOf(members.filter((c) => c.colour[d] <= mean[d])), boxOf(members.filter((c) => c.colour[d] > mean[d])));
  }
  const number = new Map();
  boxes.forEach((box, i) => box.members.forEach((cell) => number.set(cell.key, i)));
  return { colours: boxes.map((box) => box.mean.map(Math.round)), number };
}

const crcTable = Int32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? (n >>> 1) ^ 0xedb88320 : n >>> 1;
  return n;
});

function chunk(kind, content) {
  const bytes = Buffer.concat([Buffer.alloc(4), Buffer.from(kind, 'latin1'), content, Buffer.alloc(4)]);
  bytes.writeUInt32BE(content.length, 0);
  let crc = -1;
  for (let i = 4; i < bytes.length - 4; ++i) crc = crcTable[(crc ^ bytes[i]) & 255] ^ (crc >>> 8);
  bytes.writeInt32BE(~crc, bytes.length - 4);
  return bytes;
}

/// A PNG of at most 256 colours, half the size of a true-colour one.
function png(rgba, down) {
  const { colours, number } = palette(rgba, 256);
  const rows = Buffer.alloc(down * (width + 1)); // each begins with 0: no filter
  for (let y = 0, i = 0; y < down; ++y)
    for (let x = 0; x < width; ++x, i += 4)
      rows[y * (width + 1) + x + 1] = number.get(((rgba[i] >> 2) << 12) | ((rgba[i + 1] >> 2) << 6) | (rgba[i + 2] >> 2));
  const header = Buffer.from([0, 0, 0, 0, 0, 0, 0, 0, 8, 3, 0, 0, 0]); // 8 bits a pixel, of a palette
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(down, 4);
  return Buffer.concat([Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]), chunk('IHDR', header), chunk('PLTE', Buffer.from(colours.flat())),
    chunk('IDAT', deflateSync(rows, { level: 9 })), chunk('IEND', Buffer.alloc(0))]);
}

async function main() {
  let options;
  try {
    options = parseArgs({ allowPositionals: true, options: { rockfold: { type: 'string' }, chromium: { type: 'string' }, out: { type: 'string' }, help: { type: 'boolean', short: 'h' } } });
  } catch (error) {
    throw new Failure(`${error.message.split('. ')[0]} (--help lists the options)`);
  }
  const { values, positionals } = options;
  if (values.help) return console.log(usage);
  const names = positionals.length ? positionals : readdirSync(cases).filter((name) => existsSync(join(cases, name, 'picture.json'))).sort();
  const pictures = names.flatMap((name) => readPictures(name).map((picture) => [name, picture]));
  const rockfold = program('the program rockfold', values.rockfold ?? join(root, 'build', 'release', 'rockfold'));
  const chromium = playwright();
  const executablePath = program('Chromium', values.chromium);
  const out = values.out ?? join(root, 'docs', 'images');
  mkdirSync(out, { recursive: true });
  const folder = mkdtempSync(join(tmpdir(), 'rockfold-gallery-'));
  let browser;
  try {
    browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });
    for (const [name, picture] of pictures) {
      const page = writePage(name, picture, rockfold, folder);
      const { down, rgba } = await draw(browser, page, picture).catch((error) => { throw new Failure(`${name}: ${error.message}`); });
      const file = join(out, `${picture.image ?? name}.png`);
      const bytes = png(rgba, down);
      writeFileSync(file, bytes);
      console.log(`${file}: ${width} × ${down}, ${Math.round(bytes.length / 1000)} kB`);
      rmSync(join(folder, name), { recursive: true });
    }
  } finally {
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
  }
}

try {
  await main();
} catch (error) {
  console.error(error instanceof Failure ? `draw_gallery: ${error.message}` : error);
  process.exitCode = 1;
}
