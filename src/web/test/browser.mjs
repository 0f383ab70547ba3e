// node browser.mjs FOLDER CHROMIUM: opens the pages in FOLDER (wedge, tunnel, fall, slide, hostile .html, and the reports tunnel, hostile .report.html) in a real browser without
// a network, uses them as a person would, and looks at what happens. Pictures are compared by coarse features.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const [, , folder, executablePath] = process.argv;
const packages = process.env.NODE_PATH;
const { chromium } = createRequire(packages ? join(packages, 'x.js') : import.meta.url)('playwright-core');
const browser = await chromium.launch({
  executablePath,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
const slow = 3_000_000; // ms: a net for what hangs; a busy machine that draws without a graphics card takes minutes

/// A page without a network, when it has drawn what it shows (or, not `whole`, when it has been read); errors of the console and requests beyond its own file are failures.
async function open(name, address = '', whole = true) {
  const context = await browser.newContext({ viewport: { width: 1190, height: 520 }, offline: true, reducedMotion: 'reduce', acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(slow);
  page.faults = [];
  page.on('console', (message) => message.type() === 'error' && page.faults.push(message.text()));
  page.on('pageerror', (error) => page.faults.push(error.message));
  page.on('request', (request) => /^(file|data|blob):/.test(request.url()) || page.faults.push(`asks for ${request.url()}`));
  await page.goto(`file://${join(folder, name)}.html${address}`);
  if (!whole) return page;
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.ready), 'yes');
  return page;
}

async function close(page) {
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// The picture as 24 × 16 colours.
const picture = (page) => page.evaluate(() => {
  const small = document.createElement('canvas');
  [small.width, small.height] = [24, 16];
  const paint = small.getContext('2d');
  window.rockfold.scene.draw();
  paint.drawImage(window.rockfold.scene.canvas, 0, 0, 24, 16);
  return [...paint.getImageData(0, 0, 24, 16).data];
});
/// Mean difference of a colour, 0 … 255.
const difference = (a, b) => a.reduce((sum, v, i) => sum + Math.abs(v - b[i]), 0) / a.length;
const state = (page) => page.evaluate(() => window.rockfold.store.state);
/// Where a block's middle is on the screen.
const placeOf = (page, id) => page.evaluate((block) => {
  const { scene, surface } = window.rockfold;
  const b = window.rockfold.indexOf(block);
  const middle = scene.camera.position.clone().set(0, 0, 0);
  const from = surface.pointBegin[b];
  const to = surface.pointBegin[b + 1];
  for (let p = from; p < to; ++p) for (let d = 0; d < 3; ++d) middle.setComponent(d, middle.getComponent(d) + surface.point[3 * p + d] / (to - from));
  middle.project(scene.camera);
  const box = scene.canvas.getBoundingClientRect();
  return { x: box.left + (0.5 + 0.5 * middle.x) * box.width, y: box.top + (0.5 - 0.5 * middle.y) * box.height };
}, id);

const tests = {
  'a click picks the block under it, beside it none': async () => {
    const page = await open('wedge');
    await page.evaluate(() => window.rockfold.flyToBlock(4));
    const { x, y } = await placeOf(page, 4);
    await page.mouse.click(x, y);
    assert.equal((await state(page)).selected, 4);
    await page.click('#tab-block');
    assert.match(await page.textContent('.info'), /Block 4.*Factor of safety.*0\.94/s);
    await page.evaluate(() => window.rockfold.lookFrom(-42, 28));
    const corner = await page.evaluate(() => { const b = window.rockfold.scene.canvas.getBoundingClientRect(); return [b.left + 4, b.top + 4]; });
    await page.mouse.click(...corner);
    assert.equal((await state(page)).selected, 0);
    await close(page);
  },

  'the table sorts, selects and flies to a block': async () => {
    const page = await open('tunnel');
    await page.click('#tab-keys');
    await page.click('th button:has-text("F.S.")');
    const safety = await page.$$eval('tbody tr td:nth-child(3)', (cells) => cells.map((c) => Number(c.textContent)));
    assert.ok(safety.length > 5 && safety.every((f, i) => i === 0 || f >= safety[i - 1]));
    const before = await page.evaluate(() => window.rockfold.control.pose);
    await page.click('tbody tr:nth-child(3)');
    const block = await page.getAttribute('tbody tr:nth-child(3)', 'data-block');
    assert.equal((await state(page)).selected, Number(block));
    const after = await page.evaluate(() => window.rockfold.control.pose);
    assert.ok(Math.hypot(...after.map((v, i) => v - before[i])) > 1);
    await page.waitForFunction((id) => location.hash.includes(`selected=${id}`), block);
    await close(page);
  },

  'a cut shows caps with outlines, and the other side': async () => {
    const page = await open('wedge');
    const whole = await picture(page);
    await page.locator('#view').focus();
    await page.keyboard.press('2');
    const cut = await picture(page);
    assert.ok(difference(whole, cut) > 3);
    // From the removed side a cap is seen: the block there is picked where the cut is, not behind it.
    await page.evaluate(() => window.rockfold.store.set({ clip: [{ on: false, at: 0.5, flip: false }, { on: true, at: 0.4, flip: true }, { on: false, at: 0.5, flip: false }] }));
    await page.evaluate(() => window.rockfold.lookFrom(-90, 0));
    const hit = await page.evaluate(() => { const { scene } = window.rockfold; const p = scene.pick(scene.canvas.clientWidth / 2 - 40, scene.canvas.clientHeight / 2 + 40); return p && [p.at.x, p.at.y, p.at.z]; });
    const plane = await page.evaluate(() => { const { low, high } = window.rockfold.surface; return low[1] + 0.4 * (high[1] - low[1]); });
    assert.ok(hit && Math.abs(hit[1] - plane) < 0.01, `${hit} is not on the cut at ${plane}`);
    assert.ok(await page.evaluate(() => window.rockfold.scene.renderer.info.render.calls) <= 10);
    await page.fill('#clip-y-at', '0.9');
    assert.ok(difference(cut, await picture(page)) > 1);
    await close(page);
  },

  'a cut through rock is solid: caps everywhere but in the opening': async () => {
    const page = await open('tunnel'); // cut lengthwise at first
    await page.evaluate(() => window.rockfold.lookFrom(0, 0));
    const [onPlane, behind] = await page.evaluate(() => {
      const { scene, surface, store } = window.rockfold;
      const x = surface.low[0] + store.state.clip[0].at * (surface.high[0] - surface.low[0]);
      const found = [0, 0];
      for (let i = 1; i < 10; ++i)
        for (let j = 1; j < 10; ++j) {
          const p = scene.pick((i / 10) * scene.canvas.clientWidth, (j / 10) * scene.canvas.clientHeight);
          if (p) ++found[Math.abs(p.at.x - x) < 0.02 ? 0 : 1];
        }
      return found;
    });
    // Seen from the side the tunnel, 7 of 26 m high, is a band: more than half of what is hit is cap, and some is wall.
    assert.ok(onPlane > 1.5 * behind && behind > 0, `${onPlane} on the cut, ${behind} behind it`);
    await close(page);
  },

  'the slider of time moves the rock, plots follow': async () => {
    const page = await open('fall');
    await page.fill('#time', '0');
    const first = await picture(page);
    assert.match(await page.textContent('.time'), /^0 s/);
    await page.fill('#time', '2');
    assert.ok(difference(first, await picture(page)) > 1);
    await page.click('#tab-plots');
    assert.match(await page.textContent('.plot-keys'), /centre.*1\.25 m/s); // g t² / 2 at half a second, g = 10
    await page.click('#play');
    // Stopped in the frame that is past: on a slow machine the end may come before a click from outside.
    const stopped = await page.evaluate(() => new Promise((done) => {
      const { store } = window.rockfold;
      const look = () => {
        if (!(store.state.at > 2.2)) return requestAnimationFrame(look);
        document.querySelector('#play').click();
        done(store.state.at);
      };
      look();
    }));
    await page.waitForTimeout(300);
    assert.equal((await state(page)).at, stopped);
    await close(page);
  },

  'contact points are dots in blocks seen through, and follow the slider': async () => {
    const page = await open('slide');
    const solid = await picture(page);
    await page.selectOption('#field', 'contact_state');
    const dots = await picture(page);
    assert.ok(difference(solid, dots) > 1, 'blocks are ghosts');
    const words = await page.textContent('.at-legend');
    for (const name of ['open', 'stick', 'slide']) assert.match(words, new RegExp(name));
    const count = () => page.evaluate(() => { const { object } = window.rockfold.dots; return object.visible ? object.geometry.getAttribute('position').count : 0; });
    assert.ok((await count()) >= 4, 'a cube stands on four points at least');
    const farthest = () => page.evaluate(() => Math.max(...[...window.rockfold.dots.object.geometry.getAttribute('position').array].filter((_, i) => i % 3 === 0)));
    const last = await farthest();
    await page.fill('#time', '0');
    // a t² / 2 with a = g (sin 30° − tan 20° cos 30°) = 1.81 m/s², t = 0.4 s
    assert.ok(Math.abs(last - (await farthest()) - 0.145) < 0.01, 'they go with the block');
    await page.click('#tab-plots');
    const contacts = page.locator('.plots section', { hasText: 'Contact points' });
    assert.match(await contacts.locator('.plot-keys').textContent(), /open.*stick 5.*slide 0/s); // a cube's corners and middle, at first
    await page.selectOption('#field', 'contact_slip');
    await page.waitForFunction(() => /Slip of joints, m/.test(document.querySelector('.at-legend').textContent));
    await page.selectOption('#field', 'displacement');
    assert.equal(await count(), 0);
    await page.fill('#time', '20');
    await page.selectOption('#show', 'moved');
    await page.selectOption('#rest', 'hidden');
    const shown = await page.evaluate(() => [...window.rockfold.flags(window.rockfold.store.state)].filter((f) => f === 0).length);
    assert.equal(shown, 1); // the cube has moved, the floor has not
    await close(page);
  },

  'flying moves the camera into the tunnel': async () => {
    const page = await open('tunnel');
    await page.evaluate(() => { window.rockfold.store.set({ clip: [0, 1, 2].map(() => ({ on: false, at: 0.5, flip: false })) }); window.rockfold.control.pose = [0, -14, -2, 0, -13, -2]; });
    await page.locator('#view').focus();
    await page.keyboard.press('g');
    const outside = await picture(page);
    await page.keyboard.down('w');
    await page.waitForFunction(() => window.rockfold.control.pose[1] > -9);
    await page.keyboard.up('w');
    assert.equal((await state(page)).fly, true);
    assert.ok(difference(outside, await picture(page)) > 3);
    const pose = await page.evaluate(() => window.rockfold.control.pose);
    const box = await page.locator('#view').boundingBox();
    await page.mouse.move(box.x + 200, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + 320, box.y + 200, { steps: 4 });
    await page.mouse.up();
    const turned = await page.evaluate(() => window.rockfold.control.pose);
    assert.ok(Math.hypot(...[0, 1, 2].map((d) => turned[d] - pose[d])) < 1e-6, 'the eye stays');
    assert.ok(Math.hypot(...[3, 4, 5].map((d) => turned[d] - pose[d])) > 0.05, 'it looks elsewhere');
    await close(page);
  },

  'hiding, isolating, colours and joints change the picture': async () => {
    const page = await open('wedge');
    let last = await picture(page);
    const changes = async (what, act) => {
      await act();
      const now = await picture(page);
      assert.ok(difference(last, now) > 0.3, what);
      last = now;
    };
    await changes('field', () => page.selectOption('#field', 'volume'));
    await changes('colours of materials', () => page.selectOption('#field', 'material'));
    await changes('another colour', () => page.fill('.at-legend input', '#ff0000'));
    assert.equal((await state(page)).paint, 'ff0000');
    await changes('theme', () => page.click('#theme'));
    await page.evaluate(() => window.rockfold.store.set({ selected: 3 }));
    await page.locator('#view').focus();
    last = await picture(page);
    await changes('isolate', () => page.keyboard.press('i'));
    await changes('all', () => page.keyboard.press('i'));
    await changes('hide', () => page.keyboard.press('h'));
    await changes('pull apart', () => page.fill('#explode', '0.5'));
    await changes('joint', () => page.click('.set >> nth=0'));
    assert.ok((await state(page)).joint >= 0);
    await close(page);
  },

  'an address brings the view back': async () => {
    const page = await open('wedge');
    await page.selectOption('#field', 'factor_of_safety');
    await page.fill('#clip-x-at', '0.7');
    await page.evaluate(() => window.rockfold.lookFrom(60, 50));
    await page.waitForFunction(() => /clip=/.test(location.hash) && /field=factor/.test(location.hash));
    await page.waitForTimeout(500);
    const address = await page.evaluate(() => location.hash);
    const seen = await picture(page);
    await close(page);
    const again = await open('wedge', address);
    assert.ok(difference(seen, await picture(again)) < 1);
    await close(again);
  },

  'sliders do block theory again: panel, legend, table and address follow, and go back': async () => {
    const page = await open('wedge');
    await page.click('#tab-what-if');
    const factor = () => page.evaluate(() => window.rockfold.keyblocks.find((k) => k.block === 4)?.factor_of_safety);
    const before = await factor();
    await page.fill('#knob-4', '20'); // friction of the only joint material, 30° in the model
    // One plane's tan φ is all that the wedge's factor is made of.
    assert.ok(Math.abs((await factor()) / before - Math.tan(Math.PI / 9) / Math.tan(Math.PI / 6)) < 1e-9);
    assert.match(await page.textContent('.what-if-result'), /Blocks that move first\s*1/);
    assert.match(await page.textContent('.command'), /--set 'joint_material.clean.friction_angle=20'/);
    await page.waitForFunction(() => /What if: batch/.test(document.querySelector('.at-legend').textContent));
    await page.waitForFunction(() => /tried=4_20/.test(location.hash));
    await page.fill('#knob-4', '60');
    assert.match(await page.textContent('.what-if-result'), /Blocks that move first\s*0/);
    await page.click('#what-if-reset');
    assert.equal(await factor(), before);
    assert.equal(await page.evaluate(() => window.rockfold.store.state.tried.length), 0);
    await close(page);
  },

  'a block is found by its number, and a wrong number is told': async () => {
    const page = await open('wedge');
    await page.fill('#search', '2');
    await page.press('#search', 'Enter');
    assert.equal((await state(page)).selected, 2);
    await page.fill('#search', '77');
    await page.press('#search', 'Enter');
    assert.equal(await page.evaluate(() => document.getElementById('search').validationMessage), 'there is no such block on this page');
    await close(page);
  },

  'the picture is saved as PNG': async () => {
    const page = await open('tunnel');
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#png')]);
    assert.equal(download.suggestedFilename(), 'tunnel.png');
    const bytes = readFileSync(await download.path());
    assert.equal(bytes.subarray(1, 4).toString(), 'PNG');
    const box = await page.locator('#view').boundingBox();
    assert.equal(bytes.readUInt32BE(16), 2 * Math.round(box.width));
    await close(page);
  },

  'names of a model are text, whatever they say': async () => {
    for (const name of ['hostile', 'hostile.report']) {
      const page = await open(name, '', name === 'hostile'); // a report's views take long, and no name of the model is in them
      assert.equal(await page.evaluate(() => window.hacked), undefined);
      assert.match(await page.textContent('h1'), /<\/script><script>window\.hacked/);
      await close(page);
    }
  },

  'a report has views of the model, and fits on A4': async () => {
    const page = await open('tunnel.report');
    const views = await page.$$eval('#views img', (images) => images.map((image) => {
      const small = document.createElement('canvas');
      const paint = small.getContext('2d');
      [small.width, small.height] = [32, 20];
      paint.drawImage(image, 0, 0, 32, 20);
      const grey = [...paint.getImageData(0, 0, 32, 20).data].filter((_, i) => i % 4 === 1);
      return { width: image.naturalWidth, contrast: Math.max(...grey) - Math.min(...grey), sum: grey.reduce((a, b) => a + b, 0) };
    }));
    assert.ok(views.length >= 4 && views.every((v) => v.width > 800 && v.contrast > 60), JSON.stringify(views));
    assert.equal(new Set(views.map((v) => v.sum)).size, views.length, 'they differ');
    assert.equal(await page.locator('#views-note').count(), 0);
    assert.equal(await page.evaluate(() => location.hash), '');
    await page.emulateMedia({ media: 'print' });
    await page.setViewportSize({ width: 688, height: 1000 }); // 182 mm: A4 without its margins
    const wide = await page.evaluate(() => [...document.querySelectorAll('body *')]
      .filter((e) => e.getBoundingClientRect().right > document.documentElement.clientWidth + 0.5 || (e.tagName === 'TD' && e.scrollWidth > e.clientWidth + 1))
      .map((e) => `${e.tagName} ${e.textContent.slice(0, 40)}`));
    assert.deepEqual(wide, []);
    assert.ok((await page.pdf({ preferCSSPageSize: true })).length > 100_000);
    await close(page);
  },
};

const wanted = process.argv[4];
let failed = 0;
for (const [name, run] of Object.entries(tests)) {
  if (wanted && !name.includes(wanted)) continue;
  const began = Date.now();
  try {
    await run();
    console.log(`ok      ${name} (${Date.now() - began} ms)`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
await browser.close();
console.log(`${failed} failed`);
process.exit(failed ? 1 : 0);
