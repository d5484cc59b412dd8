// The page about maps: every text stands in the data, in both languages; pictures are files of their own in it.

const report = JSON.parse(document.getElementById('data').textContent);
let language = report.language;

function element(tag, text, name) {
  const out = document.createElement(tag);
  if (text !== undefined) out.textContent = text;
  if (name) out.className = name;
  return out;
}

function table_of(content) {
  const out = element('table'), top = element('tr');
  content.head.forEach((words) => top.append(element('th', words)));
  out.append(top);
  for (const cells of content.rows) {
    const row = element('tr');
    cells.forEach((cell, at) => row.append(element('td', cell, at === 3 ? 'words' : '')));
    out.append(row);
  }
  return out;
}

function figure_of(picture) {
  const out = element('figure'), image = element('img', undefined, 'picture');
  image.src = picture.data;
  image.alt = picture.name;
  out.append(image, element('figcaption', picture.name));
  return out;
}

function section_of(content, pictures) {
  const out = element('section', undefined, 'panel'), tables = element('div', undefined, 'columns');
  out.append(element('h2', content.title));
  pictures.forEach((picture) => out.append(figure_of(picture)));
  content.tables.forEach((one) => {
    const wide = element('div', undefined, 'wide');
    wide.append(table_of(one));
    tables.append(wide);
  });
  out.append(tables);
  return out;
}

function show_all() {
  const texts = report.texts[language];
  document.documentElement.lang = language;
  document.title = `${report.title} – ${texts.report}`;
  document.getElementById('title').textContent = report.title;
  for (const [id, words] of [['subtitle', texts.subtitle], ['language', texts.other_language], ['theme', texts.theme]]) {
    document.getElementById(id).textContent = words;
  }
  document.getElementById('sections').replaceChildren(
    ...texts.sections.map((content, at) => section_of(content, report.pictures[at])));
}

document.getElementById('language').addEventListener('click', () => { language = language === 'en' ? 'zh' : 'en'; show_all(); });
follow_theme(() => {});
show_all();
