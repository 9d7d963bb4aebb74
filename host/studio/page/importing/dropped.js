// Files that a person drops or chooses, as [{file, name}]; the name is a path where a folder was dropped, so that a
// figure finds its textures. Hidden files, which systems put into folders, are left out.

const isHidden = (name) => name.split("/").some((part) => part.startsWith("."));
const shown = (files) => files.filter(({name}) => !isHidden(name));

export const chosenFiles = (list) => shown([...list].map((file) => ({file, name: file.name})));

// Only while the drop is being handled does the browser say what it has.
export async function droppedFiles(transfer) {
  const items = [...transfer.items].filter(({kind}) => kind === "file")
    .map((item) => item.webkitGetAsEntry?.() ?? item.getAsFile());
  return shown((await Promise.all(items.map((item) => item instanceof File ? [{file: item, name: item.name}] : filesBelow(item, "")))).flat());
}

async function filesBelow(entry, above) {
  const name = above + entry.name;
  if (entry.isFile) return [{file: await new Promise((done, failed) => entry.file(done, failed)), name}];
  const reader = entry.createReader(), entries = [];
  for (let more; (more = await new Promise((done, failed) => reader.readEntries(done, failed))).length > 0;) entries.push(...more);
  return (await Promise.all(entries.map((each) => filesBelow(each, `${name}/`)))).flat();
}
