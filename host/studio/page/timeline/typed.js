// Steps as commands, as a person types them (docs/studio.md, "Files and history").

// Words that a shell would read otherwise are quoted. An import names no film.
export function typed([program, ...words], film) {
  const quoted = (word) => /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
  return ["mars", program, ...(program === "import" ? [] : [film]), ...words].map(quoted).join(" ");
}
