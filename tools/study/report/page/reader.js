// A reader's way through the frames of a report. The page has the globals page, show_frame and show_all.

function show_heading(title, subtitle) {
  const w = words();
  document.documentElement.lang = page.language;
  document.title = `${title} – ${w.report}`;
  document.querySelectorAll('[data-word]').forEach((node) => { node.textContent = w[node.dataset.word]; });
  document.getElementById('title').textContent = title;
  document.getElementById('subtitle').textContent = subtitle;
  document.getElementById('language').textContent = w.other_language;
  document.getElementById('theme').textContent = w.theme;
}

function on(id, event, act) { document.getElementById(id).addEventListener(event, act); }

function listen_to_reader(frames) {
  const slider = document.getElementById('slider');
  slider.max = frames - 1;
  slider.addEventListener('input', () => show_frame(Number(slider.value)));
  on('language', 'click', () => { page.language = page.language === 'en' ? 'zh' : 'en'; show_all(); });
  document.addEventListener('keydown', (event) => {
    if (event.target.tagName === 'INPUT') return;
    const step = { ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10 }[event.key];
    if (step) { event.preventDefault(); show_frame(page.frame + step); }
  });
  window.addEventListener('resize', () => show_frame(page.frame));
}

// report.html#12 opens at frame 12, counted from 0 as in the tables.
function frame_of_address() { return Number(location.hash.slice(1)) || 0; }

function begin_page(language) {
  page.language = language;
  page.frame = frame_of_address();
  window.addEventListener('hashchange', () => show_frame(frame_of_address()));
  follow_theme(() => show_frame(page.frame));
}
