// The copy buttons of a finding's page.
"use strict";

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Not allowed here, as in a page of a plain web server: the old way.
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    if (!done) throw new Error("the browser does not let this page copy");
  }
}

for (const button of document.querySelectorAll("button.copy")) {
  button.addEventListener("click", async () => {
    let word = "Copied";
    try {
      await copy(document.getElementById(button.dataset.copy).textContent);
    } catch {
      word = "Select it and copy";
    }
    button.textContent = word;
    button.focus();
    document.getElementById("said").textContent = word;
    setTimeout(() => { button.textContent = "Copy"; }, 2000);
  });
}
