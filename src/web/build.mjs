// node build.mjs FOLDER: bundles the page into FOLDER/page.html.gz, with its length in FOLDER/page.html.size; likewise views.js, the
// script of a report's views.
// NODE_PATH names the folder of the packages where they do not lie beside this file.
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const packages = process.env.NODE_PATH;
const require = createRequire(packages ? join(packages, 'x.js') : import.meta.url);
const esbuild = require('esbuild');

export async function bundle(entry, options = {}) {
  const result = await esbuild.build({
    entryPoints: [join(here, entry)],
    bundle: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    charset: 'ascii',
    legalComments: 'inline', // three.js asks that its licence stays with it
    nodePaths: packages ? [packages] : [],
    ...options,
  });
  return result.outputFiles[0].text;
}

async function build(folder) {
  const script = await bundle('main.ts', { minify: true });
  const style = await bundle('style.css', { minify: true, loader: { '.css': 'css' } });
  const page = readFileSync(join(here, 'page.html'), 'utf8')
    .replace('<!--style-->', () => `<style>${style}</style>`)
    .replace('<!--script-->', () => `<script>${script}</script>`);
  store(folder, 'page.html', page);
  store(folder, 'views.js', await bundle('views.ts', { minify: true }));
}

function store(folder, name, text) {
  const bytes = Buffer.from(text, 'utf8');
  writeFileSync(join(folder, `${name}.gz`), gzipSync(bytes, { level: 9 }));
  writeFileSync(join(folder, `${name}.size`), `${bytes.length}\n`);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await build(process.argv[2]);
