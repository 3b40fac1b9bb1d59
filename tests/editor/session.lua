-- What a person does in Neovim, with its own client of the language server protocol. The environment names the program, the listing and
-- the file for the report.

local program, listing, report = vim.env.TEXCRD, vim.env.LISTING, vim.env.REPORT
-- How long something may take, in milliseconds: machines that test are slow and do other things.
local PATIENCE = 30000
local found = {}

local function wait(what, is)
  if not vim.wait(PATIENCE, is, 20) then
    error('waited for ' .. what)
  end
end

local function diagnostics()
  local shown = {}
  for _, one in ipairs(vim.diagnostic.get(0)) do
    local code = one.code or (one.user_data and one.user_data.lsp and one.user_data.lsp.code)
    table.insert(shown, string.format('%s %d:%d-%d:%d', code, one.lnum, one.col, one.end_lnum, one.end_col))
  end
  table.sort(shown)
  return shown
end

local function lines()
  return vim.api.nvim_buf_get_lines(0, 0, -1, false)
end

local function session()
  vim.cmd('edit ' .. vim.fn.fnameescape(listing))
  vim.bo.filetype = 'd3d8asm'
  local id = vim.lsp.start_client({
    name = 'texcrd',
    cmd = { program, 'lsp' },
    root_dir = vim.fn.fnamemodify(listing, ':h'),
    on_exit = function(code)
      found.exit = code
    end,
  })
  vim.lsp.buf_attach_client(0, id)
  local client = vim.lsp.get_client_by_id(id)
  wait('the greeting', function()
    return client.initialized
  end)
  local function ask(method, line, character, more)
    local params = { textDocument = vim.lsp.util.make_text_document_params(), position = { line = line, character = character } }
    -- The number of the buffer, not 0: only so are changes sent before the question.
    local buffer = vim.api.nvim_get_current_buf()
    local answer = client.request_sync(method, vim.tbl_extend('force', params, more or {}), PATIENCE, buffer)
    assert(answer and not answer.err, method .. ': ' .. vim.inspect(answer))
    return answer.result
  end
  local function range(one)
    local start, stop = one.range.start, one.range['end']
    return string.format('%d:%d-%d:%d', start.line, start.character, stop.line, stop.character)
  end

  wait('diagnostics', function()
    return #vim.diagnostic.get(0) > 0
  end)
  found.diagnostics = diagnostics()

  -- The repair that the server offers for the first of them.
  local actions = ask('textDocument/codeAction', 2, 0, {
    range = { start = { line = 2, character = 0 }, ['end'] = { line = 2, character = 3 } },
    context = { diagnostics = {}, only = { 'quickfix' } },
  })
  found.action = actions[1].title
  vim.lsp.util.apply_workspace_edit(actions[1].edit, client.offset_encoding)
  found.repaired = lines()[3]

  -- A person types the rest: r9 becomes r1. Neovim sends what has changed.
  local row = 3
  local column = assert(lines()[row + 1]:find('r9', 1, true))
  vim.api.nvim_buf_set_text(0, row, column, row, column + 1, { '1' })
  wait('no diagnostics', function()
    return #vim.diagnostic.get(0) == 0
  end)

  found.hover = ask('textDocument/hover', 3, 1).contents.value
  found.highlights = vim.tbl_map(function(one)
    return one.kind .. ' ' .. range(one)
  end, ask('textDocument/documentHighlight', 2, 4))
  local definition = ask('textDocument/definition', 2, 16)
  vim.lsp.util.jump_to_location(definition[1], client.offset_encoding)
  found.cursor = vim.api.nvim_win_get_cursor(0)

  -- What is offered behind `r0.` where a result is written.
  vim.api.nvim_buf_set_lines(0, -1, -1, false, { 'mov r0.' })
  local items = ask('textDocument/completion', #lines() - 1, 7).items
  found.completion = vim.tbl_map(function(item)
    return item.label
  end, items)
  vim.api.nvim_buf_set_lines(0, -2, -1, false, { 'mov   r0.rgb,r1' })
  vim.lsp.buf.formatting_sync(nil, PATIENCE)
  found.lines = lines()

  vim.lsp.stop_client(id)
  wait('the end of the server', function()
    return found.exit ~= nil
  end)
end

local done, problem = pcall(session)
found.problem = not done and tostring(problem) or nil
local file = assert(io.open(report, 'w'))
file:write(vim.fn.json_encode(found))
file:close()
vim.cmd('qa!')
