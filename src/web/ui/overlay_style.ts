// How what lies over the picture looks, on the page and in an exported image.

export interface Theme {
  background: string;
  panel: string;
  ink: string;
  soft: string;
  none: string;
  accent: string;
}

export const themes: Record<'light' | 'dark', Theme> = {
  light: { background: '#eef1f5', panel: '#ffffff', ink: '#15191e', soft: '#5a6570', none: '#c2c8cf', accent: '#d6117f' },
  dark: { background: '#12161b', panel: '#1c2229', ink: '#eef2f6', soft: '#a3afbb', none: '#6a7480', accent: '#ff4fae' },
};

export const overlayStyle = `
text { font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif; fill: var(--ink); }
.legend-box { fill: var(--panel); fill-opacity: 0.9; stroke: var(--soft); stroke-opacity: 0.35; }
.legend-title { font-size: 13px; font-weight: 600; }
.legend-text { font-size: 12px; }
.legend-tick { stroke: var(--ink); stroke-width: 1; }
.legend-swatch { stroke: var(--soft); stroke-opacity: 0.6; }
.bar-outline { fill: var(--panel); stroke: var(--ink); stroke-width: 1; }
.bar-fill { fill: var(--ink); }
.scale-bar text, .compass text, .label { paint-order: stroke; stroke: var(--background); stroke-width: 3px; stroke-linejoin: round; }
.compass line { stroke: var(--soft); stroke-width: 1.6; }
.compass .north line { stroke: var(--ink); stroke-width: 2.4; }
.compass .north polygon { fill: var(--ink); }
.compass .north text { font-weight: 700; }
.label { font-size: 12px; font-weight: 600; }
.picture-title { font-size: 15px; font-weight: 600; }
`;

export function variables(theme: Theme): string {
  return Object.entries(theme).map(([name, value]) => `--${name}: ${value};`).join(' ');
}
