// node what_if.mjs PAGE.html SEED COUNT: what the page answers to COUNT random settings of its sliders, as JSON on stdout: the
// texts for --set, key blocks, those that stay, and what is left to the program. tests/page/what_if_test.py compares it with the program.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { bundle } from '../build.mjs';

const [, , page, seed, count] = process.argv;
const folder = mkdtempSync(join(tmpdir(), 'rockfold-what-if-'));
const script = join(folder, 'page.mjs');
writeFileSync(script, await bundle('test/page_of_text.ts', { format: 'esm', platform: 'node', charset: 'utf8' }));
const { whatIfOf, randomTries } = await import(script);
rmSync(folder, { recursive: true });

const whatIf = await whatIfOf(readFileSync(page, 'utf8'));
const answers = [];
for (const tried of randomTries(whatIf.knobs, Number(seed), Number(count))) {
  whatIf.apply(tried);
  const { keyblocks, stable, byProgram, groups } = whatIf.outcome;
  answers.push({ sets: whatIf.overrides(), keyblocks, stable, by_program: [...byProgram], groups, milliseconds: whatIf.milliseconds });
}
process.stdout.write(JSON.stringify(answers));
