// Starts the page: reads what it holds, then hands it to the parts.
import { App } from './app';
import { readPage } from './data';
import { h } from './ui/dom';

async function start(): Promise<void> {
  const root = document.getElementById('app')!;
  try {
    if (typeof DecompressionStream === 'undefined') throw new Error('this browser is too old: it cannot unpack the data');
    const app = new App(root, await readPage(document));
    // For tests, and for people at the console.
    (window as unknown as { rockfold: App }).rockfold = app;
    document.documentElement.dataset.ready = 'yes';
  } catch (error) {
    root.replaceChildren(h('p', { class: 'failure' }, `The page cannot be shown: ${error instanceof Error ? error.message : String(error)}`));
    document.documentElement.dataset.ready = 'failed';
    console.error(error);
  }
}

void start();
