// node run.mjs FOLDER: bundles test/*_test.ts into FOLDER and runs them with Node's own test runner.
import { spawnSync } from 'node:child_process';
import { mkdirSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { bundle } from '../build.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, '..', 'node_modules', '.tests');
mkdirSync(out, { recursive: true });
const files = readdirSync(here).filter((name) => name.endsWith('_test.ts'));
for (const name of files)
  writeFileSync(join(out, name.replace(/\.ts$/, '.mjs')), await bundle(`test/${name}`, { format: 'esm', platform: 'node', charset: 'utf8' }));
const { status } = spawnSync(process.execPath, ['--test', ...files.map((name) => join(out, name.replace(/\.ts$/, '.mjs')))], { stdio: 'inherit' });
process.exit(status ?? 1);
