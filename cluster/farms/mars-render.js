// A job type of Flamenco: copy this file to the manager's folder `scripts`.
const JOB_TYPE = {
  label: "MARS",
  settings: [
    { key: "film", type: "string", required: true, description: "The film; workers see it under this path." },
    { key: "folder", type: "string", required: true, description: "Where frames go." },
    { key: "frames", type: "string", required: true, default: "0-239", description: "Frames, counted from 0." },
    { key: "chunk_size", type: "int32", default: 24, description: "Frames of a task." },
  ],
};

function compileJob(job) {
  const settings = job.settings;
  const verify = author.Task("verify", "misc");
  verify.addCommand(author.Command("exec", { exe: "mars", args: ["verify", settings.folder] }));
  for (const frames of frameChunker(settings.frames, settings.chunk_size)) {
    const task = author.Task(`render-${frames}`, "misc");
    const args = ["render", settings.film, "-o", settings.folder, "--frames", frames, "--restarts", "0"];
    task.addCommand(author.Command("exec", { exe: "mars", args: args }));
    job.addTask(task);
    verify.addDependency(task);
  }
  job.addTask(verify);
}
